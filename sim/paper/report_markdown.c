#include "markup.h"
#include "report.h"

static void write_overview(const struct report *report, FILE *out)
{
    fputs("| figure | what it shows | the claim |\n|---|---|---|\n", out);
    for (size_t i = 0; i < report->count; i++) {
        const struct figure *figure = &report->figures[i];

        fprintf(out, "| %d | ", figure->number);
        markup_cell(out, figure->title);
        fprintf(out, " | %s |\n", verdict_words[figure->finding[0].verdict]);
    }
}

static void write_table(FILE *out, const struct table *table)
{
    fprintf(out, "\n%s:\n\n|", table->title);
    for (size_t i = 0; i < table->columns; i++) {
        fputc(' ', out);
        markup_cell(out, table->column[i].head);
        fputs(" |", out);
    }
    fputs("\n|", out);
    for (size_t i = 0; i < table->columns; i++)
        fputs(table->cell[i].number ? "---:|" : "---|", out);
    for (size_t i = 0; i < table->cells; i++) {
        fputs(i % table->columns == 0 ? "\n| " : " ", out);
        markup_cell(out, table->cell[i].text);
        fputs(" |", out);
    }
    fputc('\n', out);
}

static void write_figure(FILE *out, const struct figure *figure)
{
    fprintf(out, "\n## Figure %d: %s\n\n%s\n\n", figure->number, figure->title, figure->shows);
    for (size_t i = 0; i < figure->findings; i++) {
        const struct finding *finding = &figure->finding[i];

        fprintf(out, "- *%s* **%s.** %s\n", finding->claim, verdict_words[finding->verdict],
                finding->reason);
    }
    for (size_t i = 0; i < figure->tables; i++)
        write_table(out, &figure->table[i]);
}

void report_markdown(const struct report *report, FILE *out)
{
    fprintf(out,
            "# The paper's figures, run again\n\n"
            "`make paper` writes this file; no number in it is typed by hand. It makes every figure of "
            "the paper that can be made again, sets the paper's claim, in our words, beside what comes "
            "out, and says whether the claim holds. The same with pictures is "
            "`build/paper/report.html`, for programs `build/paper/summary.json`. What the paper "
            "measured is not ours to repeat: figures 14 to 19 are its experiments as simulations.\n\n"
            "Robots: %s.\n\n",
            report_robots(report));
    write_overview(report, out);
    for (size_t i = 0; i < report->count; i++)
        write_figure(out, &report->figures[i]);
}
