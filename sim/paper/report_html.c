#include "markup.h"
#include "page.h"
#include "report.h"

static const char *verdict_class(enum verdict verdict)
{
    static const char *const classes[] = {
        [HOLDS] = "holds", [FAILS] = "fails", [UNTOLD] = "untold"};

    return classes[verdict];
}

static void write_verdict(FILE *out, enum verdict verdict)
{
    static const char *const signs[] = {[HOLDS] = "\u2713", [FAILS] = "\u2717", [UNTOLD] = "?"};

    fprintf(out, "<span class=\"verdict %s\">%s ", verdict_class(verdict), signs[verdict]);
    markup_text(out, verdict_words[verdict]);
    fputs("</span>", out);
}

static void write_head(const struct report *report, FILE *out)
{
    page_open(out, "The paper's figures, run again");
    fputs("<h1>The paper\u2019s figures, run again</h1>\n"
          "<p>Kwon, Kim and Seo, \u201cMultiple Leader Candidate and Competitive Position "
          "Allocation for Robust Formation against Member Robot Faults\u201d, <i>Sensors</i> 15 "
          "(2015) 10771, with Muster: every figure that shows a result, what the paper claims with "
          "it, in our words, and whether that holds.</p>\n",
          out);
    fprintf(out,
            "<p>Of the claims of %zu figures %zu hold, %zu do not, and %zu cannot be told from "
            "print. The paper's other figures explain the method and the set-up.</p>\n",
            report->count, report_verdicts(report, HOLDS), report_verdicts(report, FAILS),
            report_verdicts(report, UNTOLD));
    fprintf(out, "<p class=\"soft\">Robots: %s. All of it took %.0f s.</p>\n",
            report_robots(report), report->wall);
}

static void write_overview(const struct report *report, FILE *out)
{
    fputs(
        "<div class=\"scroll overview\"><table>\n<tr><th>Figure</th><th>What it shows</th><th>The "
        "claim</th></tr>\n",
        out);
    for (size_t i = 0; i < report->count; i++) {
        const struct figure *figure = &report->figures[i];

        fprintf(out, "<tr><td><a href=\"#figure-%d\">%d</a></td><td>", figure->number,
                figure->number);
        markup_text(out, figure->title);
        fputs("</td><td>", out);
        write_verdict(out, figure->finding[0].verdict);
        fputs("</td></tr>\n", out);
    }
    fputs("</table></div>\n", out);
}

static void write_finding(FILE *out, const struct finding *finding)
{
    fprintf(out, "<div class=\"finding %s\">\n<p>", verdict_class(finding->verdict));
    page_element(out, "span", "claim", finding->claim);
    fputc(' ', out);
    write_verdict(out, finding->verdict);
    fputs("</p>\n<p>", out);
    markup_text(out, finding->reason);
    fputs("</p>\n</div>\n", out);
}

static void write_panel(FILE *out, const struct panel *panel)
{
    fprintf(out, "<figure class=\"%s\">\n", panel->wide ? "wide" : "");
    panel->draw(out, panel);
    page_element(out, "figcaption", "", panel->caption);
    fputs("\n</figure>\n", out);
}

static void write_cell(FILE *out, const char *tag, bool number, const char *text)
{
    page_element(out, tag, number ? "number" : "", text);
}

static void write_table(FILE *out, const struct table *table)
{
    fputs("<div class=\"scroll\"><table>\n", out);
    page_element(out, "caption", "", table->title);
    fputs("\n<tr>", out);
    for (size_t i = 0; i < table->columns; i++)
        write_cell(out, "th", table->cell[i].number, table->column[i].head);
    for (size_t i = 0; i < table->cells; i++) {
        fputs(i % table->columns == 0 ? "</tr>\n<tr>" : "", out);
        write_cell(out, "td", table->cell[i % table->columns].number, table->cell[i].text);
    }
    fputs("</tr>\n</table></div>\n", out);
}

static void write_figure(FILE *out, const struct figure *figure)
{
    fprintf(out, "<section id=\"figure-%d\">\n<h2>Figure %d: ", figure->number, figure->number);
    markup_text(out, figure->title);
    fputs("</h2>\n", out);
    page_element(out, "p", "", figure->shows);
    fputc('\n', out);
    for (size_t i = 0; i < figure->findings; i++)
        write_finding(out, &figure->finding[i]);
    fputs("<div class=\"panels\">\n", out);
    for (size_t i = 0; i < figure->panels; i++)
        write_panel(out, &figure->panel[i]);
    fputs("</div>\n", out);
    for (size_t i = 0; i < figure->tables; i++)
        write_table(out, &figure->table[i]);
    fputs("</section>\n", out);
}

/* What to type for a run of one's own. */
static void write_command(FILE *out, const struct run *run)
{
    fputs("<code>muster sim scenarios/", out);
    markup_text(out, run->file);
    for (size_t i = 0; i < run->settings; i++) {
        fputs(" --set ", out);
        markup_text(out, run->setting[i]);
    }
    fputs("</code>", out);
}

static void write_run(FILE *out, const struct run *run)
{
    const struct summary *s = &run->summary;

    fprintf(out, "<tr><td class=\"number\">%zu</td><td>%s</td><td class=\"number\">%.0f</td>",
            run->scenario->robot_count, s->avr ? "ATmega128" : "native", s->duration);
    fprintf(out, "<td class=\"number\">%.1f</td><td class=\"number\">", s->wall);
    if (s->avr)
        fprintf(out, "%.0f", s->load_max_pct);
    fputs("</td><td>", out);
    write_command(out, run);
    fputs("</td></tr>\n", out);
}

static void write_runs(const struct report *report, FILE *out)
{
    fputs(
        "<section id=\"runs\">\n<h2>The runs</h2>\n<p>Each can be repeated alone; its files are in "
        "<code>runs/</code> beside this page.</p>\n<div class=\"scroll\"><table>\n"
        "<tr><th>robots</th><th>kind</th><th>simulated (s)</th><th>took (s)</th>"
        "<th>busiest processor (%)</th><th>to see it alone</th></tr>\n",
        out);
    for (size_t i = 0; i < RUN_COUNT; i++)
        if (report->runs->all[i].done)
            write_run(out, &report->runs->all[i]);
    fputs("</table></div>\n</section>\n", out);
}

void report_html(const struct report *report, FILE *out)
{
    write_head(report, out);
    write_overview(report, out);
    for (size_t i = 0; i < report->count; i++)
        write_figure(out, &report->figures[i]);
    write_runs(report, out);
    page_close(out);
}
