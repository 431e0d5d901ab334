/* styles.h: the style sheets, as text. */
#ifndef STYLES_H
#define STYLES_H

extern const char ink_css[];  /* colours and charts, in HTML and in SVG */
extern const char page_css[]; /* the rest of an HTML page */
extern const char film_css[]; /* the rest of an animated SVG */

#endif
