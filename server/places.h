/* places.h: where the files are that come with muster: beside it in the prefix that it is installed
 * in, or in the tree that it was built in. */
#ifndef PLACES_H
#define PLACES_H

#define PLACE_MAX 4096 /* Linux allows no longer path, with its NUL */

/* Each writes a path into `path` and returns it; whether anything is there is not looked at. */
const char *place_firmware(char path[PLACE_MAX]);  /* the image of avr robots */
const char *place_loader(char path[PLACE_MAX]);    /* their boot loader */
const char *place_scenarios(char path[PLACE_MAX]); /* the folder of the shipped scenarios */

#endif
