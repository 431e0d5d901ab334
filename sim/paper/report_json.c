#include "markup.h"
#include "report.h"

static void write_field(FILE *out, const char *key, const char *text)
{
    markup_string(out, key);
    fputs(": ", out);
    markup_string(out, text);
}

static void write_cell(FILE *out, const struct cell *cell)
{
    if (cell->number)
        fputs(cell->text, out);
    else
        markup_string(out, cell->text);
}

static void write_row(FILE *out, const struct table *table, const struct cell *cell)
{
    fputc('{', out);
    for (size_t i = 0; i < table->columns; i++) {
        fputs(i > 0 ? ", " : "", out);
        markup_string(out, table->column[i].key);
        fputs(": ", out);
        write_cell(out, &cell[i]);
    }
    fputc('}', out);
}

static void write_table(FILE *out, const struct table *table)
{
    fputs("        {", out);
    write_field(out, "title", table->title);
    fputs(", \"rows\": [", out);
    for (size_t i = 0; i < table->cells; i += table->columns) {
        fputs(i > 0 ? ",\n          " : "\n          ", out);
        write_row(out, table, &table->cell[i]);
    }
    fputs("]}", out);
}

static void write_finding(FILE *out, const struct finding *finding)
{
    fputs("        {", out);
    write_field(out, "claim", finding->claim);
    fputs(", ", out);
    write_field(out, "verdict", verdict_words[finding->verdict]);
    fputs(",\n         ", out);
    write_field(out, "reason", finding->reason);
    fputc('}', out);
}

static void write_figure(FILE *out, const struct figure *figure)
{
    fprintf(out, "    \"%d\": {\n      ", figure->number);
    write_field(out, "title", figure->title);
    fputs(",\n      ", out);
    write_field(out, "verdict", verdict_words[figure->finding[0].verdict]);
    fputs(",\n      \"claims\": [\n", out);
    for (size_t i = 0; i < figure->findings; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        write_finding(out, &figure->finding[i]);
    }
    fputs("],\n      \"tables\": [\n", out);
    for (size_t i = 0; i < figure->tables; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        write_table(out, &figure->table[i]);
    }
    fputs("]\n    }", out);
}

static void write_run(FILE *out, const struct run *run)
{
    const struct summary *s = &run->summary;

    fputs("    {", out);
    write_field(out, "name", run->name);
    fputs(", ", out);
    write_field(out, "scenario", run->file);
    fputs(", \"settings\": [", out);
    for (size_t i = 0; i < run->settings; i++) {
        fputs(i > 0 ? ", " : "", out);
        markup_string(out, run->setting[i]);
    }
    fprintf(out,
            "], \"robots\": %zu, \"robot_kind\": \"%s\", \"duration\": %.2f, \"wall_s\": %.2f}",
            run->scenario->robot_count, s->avr ? "avr" : "native", s->duration, s->wall);
}

void report_json(const struct report *report, FILE *out)
{
    const char *separator = "";

    fprintf(out, "{\n  \"robot_kind\": \"%s\",\n  \"wall_s\": %.1f,\n  \"figures\": {\n",
            report->avr ? "avr" : "native", report->wall);
    for (size_t i = 0; i < report->count; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        write_figure(out, &report->figures[i]);
    }
    fputs("\n  },\n  \"runs\": [\n", out);
    for (size_t i = 0; i < RUN_COUNT; i++) {
        if (!report->runs->all[i].done)
            continue;
        fputs(separator, out);
        write_run(out, &report->runs->all[i]);
        separator = ",\n";
    }
    fputs("\n  ]\n}\n", out);
}
