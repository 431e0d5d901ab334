/* page_files.h: the page, which is in the binary: what lies in page/. */
#ifndef PAGE_FILES_H
#define PAGE_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct page_file {
    const char *type; /* Content-Type */
    const uint8_t *bytes;
    size_t count;
};

/* "/" is index.html. False: there is none of this path. */
bool page_file(const char *path, struct page_file *file);

#endif
