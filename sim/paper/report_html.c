#include "markup.h"
#include "report.h"

#include <string.h>

/* Colours that keep their distance for colour-blind eyes too (Okabe and Ito, Tol, viridis), darker on
 * light paper than on dark. */
static const char style[] =
    ":root{color-scheme:light dark;--paper:#fff;--ink:#1c1f24;--soft:#5b6470;--rule:#e3e6ea;"
    "--card:#f6f7f9;--good:#0a7a50;--bad:#c0392b;--open:#8a6100;"
    "--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#b0508c;--c4:#b57f00;--c5:#3a96cf;--c6:#882255;"
    "--c7:#117733;--m0:#440154;--m1:#482878;--m2:#3e4a89;--m3:#31688e;--m4:#26828e;--m5:#1f9e89;"
    "--m6:#35b779;--m7:#55b03c;--m8:#86a800;--m9:#a89400}\n"
    "@media(prefers-color-scheme:dark){:root{--paper:#14171b;--ink:#e6e9ed;--soft:#9aa4b0;"
    "--rule:#2c3239;--card:#1b1f25;--good:#4cc38a;--bad:#ff7b6b;--open:#e0b040;"
    "--c0:#4aa8e0;--c1:#ff8c42;--c2:#2fc79a;--c3:#df8fc0;--c4:#e8b530;--c5:#8cd0f5;--c6:#d06a98;"
    "--c7:#5cba78;--m0:#a06fc8;--m1:#8f83d6;--m2:#7d97dc;--m3:#62aadb;--m4:#4cbccf;--m5:#43cbb6;"
    "--m6:#5bd691;--m7:#8fdc6b;--m8:#c3dd52;--m9:#ecd84c}}\n"
    "*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);"
    "font:16px/1.55 system-ui,sans-serif}main{max-width:1060px;margin:0 auto;padding:2.5rem 1.25rem}\n"
    "h1{font-size:2rem;line-height:1.2;margin:0 0 .5rem}h2{font-size:1.35rem;margin:0 0 .5rem}"
    "section{border-top:1px solid var(--rule);padding-top:2rem;margin-top:2.5rem}"
    "p{max-width:46rem;margin:.5rem 0}.soft,caption,figcaption{color:var(--soft)}a{color:inherit}\n"
    ".verdict{font-weight:600;white-space:nowrap}.holds{color:var(--good)}.fails{color:var(--bad)}"
    ".untold{color:var(--open)}\n"
    ".finding{background:var(--card);border-left:4px solid;padding:.75rem 1rem;margin:1rem 0;"
    "border-radius:0 6px 6px 0}.finding p{color:var(--ink);max-width:none}.claim{font-weight:600}\n"
    ".panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr));"
    "gap:1.25rem;margin:1.25rem 0}figure{margin:0;min-width:0}figure.wide{grid-column:1/-1}"
    "figcaption{font-size:.9rem}\n"
    ".scroll{overflow-x:auto;margin:1rem 0}table{border-collapse:collapse;font-size:.9rem;"
    "font-variant-numeric:tabular-nums}caption{text-align:left;padding-bottom:.35rem}"
    "th,td{padding:.3rem .75rem;border-bottom:1px solid var(--rule);text-align:left;"
    "vertical-align:top;white-space:nowrap}th{font-weight:600}.number{text-align:right}code{font-size:.85rem}\n"
    "svg{display:block;width:100%;height:auto;font:12px system-ui,sans-serif}svg text{fill:var(--ink)}"
    ".mid{text-anchor:middle}.end{text-anchor:end}.grid{stroke:var(--rule);fill:none}"
    ".line{fill:none;stroke:var(--c);stroke-width:1.8;stroke-linejoin:round}"
    ".fine{stroke-width:.6}.mark{fill:var(--c);stroke:var(--paper);stroke-width:.8}"
    ".start{fill:none;stroke:var(--c);stroke-width:1.5}.join{stroke:var(--soft);stroke-width:.8}"
    ".ring{fill:none;stroke:var(--ink);stroke-width:1.2}.vertex{fill:none;stroke:var(--soft);"
    "stroke-dasharray:2 2}.lost{stroke:var(--bad);stroke-width:2.5}"
    ".mean{stroke:var(--ink);stroke-width:2.6}.moment{stroke:var(--soft);stroke-dasharray:3 3}"
    ".follows{fill-opacity:.3}.leads{fill-opacity:.75}\n"
    ".c0{--c:var(--c0)}.c1{--c:var(--c1)}.c2{--c:var(--c2)}.c3{--c:var(--c3)}.c4{--c:var(--c4)}"
    ".c5{--c:var(--c5)}.c6{--c:var(--c6)}.c7{--c:var(--c7)}.m0{--c:var(--m0)}.m1{--c:var(--m1)}"
    ".m2{--c:var(--m2)}.m3{--c:var(--m3)}.m4{--c:var(--m4)}.m5{--c:var(--m5)}.m6{--c:var(--m6)}"
    ".m7{--c:var(--m7)}.m8{--c:var(--m8)}.m9{--c:var(--m9)}\n"
    "@media print{section{break-inside:avoid-page}}";

static const char *verdict_class(enum verdict verdict)
{
    static const char *const classes[] = {
        [HOLDS] = "holds", [FAILS] = "fails", [UNTOLD] = "untold"};

    return classes[verdict];
}

/* <tag class="classes">text</tag> */
static void write_element(FILE *out, const char *tag, const char *classes, const char *text)
{
    fprintf(out, "<%s class=\"%s\">", tag, classes);
    markup_text(out, text);
    fprintf(out, "</%s>", tag);
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
    fprintf(out,
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
            "<meta name=\"viewport\" content=\"width=device-width\"/>\n"
            "<title>The paper's figures, run again</title>\n<style>\n%s\n</style>\n</head>\n"
            "<body>\n<main>\n<h1>The paper\u2019s figures, run again</h1>\n",
            style);
    fputs("<p>Kwon, Kim and Seo, \u201cMultiple Leader Candidate and Competitive Position Allocation "
          "for Robust Formation against Member Robot Faults\u201d, <i>Sensors</i> 15 (2015) 10771, "
          "with Muster: every figure that can be made again, what the paper claims with it, in our "
          "words, and whether that holds.</p>\n",
          out);
    fprintf(out, "<p>Of %zu figures, %zu claims hold, %zu do not, and %zu cannot be told from print. "
                 "The paper's other figures explain the method and the set-up.</p>\n",
            report->count, report_verdicts(report, HOLDS), report_verdicts(report, FAILS),
            report_verdicts(report, UNTOLD));
    fprintf(out, "<p class=\"soft\">Robots: %s. All of it took %.0f s.</p>\n", report_robots(report),
            report->wall);
}

static void write_overview(const struct report *report, FILE *out)
{
    fputs("<div class=\"scroll\"><table>\n<tr><th>Figure</th><th>What it shows</th><th>The "
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
    write_element(out, "span", "claim", finding->claim);
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
    write_element(out, "figcaption", "", panel->caption);
    fputs("\n</figure>\n", out);
}

static void write_cell(FILE *out, const char *tag, bool number, const char *text)
{
    write_element(out, tag, number ? "number" : "", text);
}

static void write_table(FILE *out, const struct table *table)
{
    fputs("<div class=\"scroll\"><table>\n", out);
    write_element(out, "caption", "", table->title);
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
    write_element(out, "p", "", figure->shows);
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
    fputs("<section id=\"runs\">\n<h2>The runs</h2>\n<p>Each can be repeated alone; its files are in "
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
    fputs("</main>\n</body>\n</html>\n", out);
}
