#include "markup.h"
#include "report.h"

#include <string.h>

#define WIDTH 110

/* Words in lines of up to WIDTH characters, all but the first behind an indent. */
static void write_wrapped(FILE *out, const char *indent, const char *text)
{
    size_t column = 0;

    while (*text != '\0') {
        size_t length = strcspn(text, " ");

        if (column > 0 && column + 1 + length > WIDTH) {
            fprintf(out, "\n%s", indent);
            column = strlen(indent);
        } else if (column > 0) {
            fputc(' ', out);
            column++;
        }
        fwrite(text, 1, length, out);
        column += length;
        text += length + (text[length] == ' ');
    }
    fputc('\n', out);
}

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

static void write_finding(FILE *out, const struct finding *finding)
{
    char words[REASON_MAX + 300];

    snprintf(words, sizeof words, "- *%s* **%s.** %s", finding->claim,
             verdict_words[finding->verdict], finding->reason);
    write_wrapped(out, "  ", words);
}

static void write_figure(FILE *out, const struct figure *figure)
{
    fprintf(out, "\n## Figure %d: %s\n\n", figure->number, figure->title);
    write_wrapped(out, "", figure->shows);
    fputc('\n', out);
    for (size_t i = 0; i < figure->findings; i++)
        write_finding(out, &figure->finding[i]);
    for (size_t i = 0; i < figure->tables; i++)
        write_table(out, &figure->table[i]);
}

void report_markdown(const struct report *report, FILE *out)
{
    fputs("# The paper's figures, run again\n\n", out);
    write_wrapped(
        out, "",
        "`make paper` writes this file; no number in it is typed by hand. It makes every figure "
        "of the paper again that shows a result, sets the paper's claim, in our words, beside "
        "what comes out, and says whether it holds. Figures 14 to 19 are the paper's "
        "experiments, here as simulations. The same with pictures is `build/paper/report.html`, "
        "for programs `build/paper/summary.json`.");
    fprintf(out, "\nRobots: %s.\n\n", report_robots(report));
    write_overview(report, out);
    for (size_t i = 0; i < report->count; i++)
        write_figure(out, &report->figures[i]);
}
