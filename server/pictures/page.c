#include "page.h"

#include "markup.h"
#include "styles.h"

void page_open(FILE *out, const char *title)
{
    fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
          "<meta name=\"viewport\" content=\"width=device-width\"/>\n<title>",
          out);
    markup_text(out, title);
    fprintf(out, "</title>\n<style>\n%s\n%s</style>\n</head>\n<body>\n<main>\n", ink_css, page_css);
}

void page_close(FILE *out)
{
    fputs("</main>\n</body>\n</html>\n", out);
}

void page_element(FILE *out, const char *tag, const char *classes, const char *text)
{
    fprintf(out, "<%s class=\"%s\">", tag, classes);
    markup_text(out, text);
    fprintf(out, "</%s>", tag);
}
