#include "page_files.h"

#include <string.h>

#define INDEX "/index.html"

/* The assembler puts a file's bytes between two names. */
#define PAGE_FILE(number, name)                                                                    \
    __asm__(".pushsection .rodata\n"                                                               \
            "page_" #number ": .incbin \"" PAGE_FOLDER "/" name "\"\n"                             \
            "page_" #number "_end: .byte 0\n"                                                      \
            ".popsection\n");                                                                      \
    extern const uint8_t page_##number[], page_##number##_end[];
#include "page_list.h"
#undef PAGE_FILE

#define PAGE_FILE(number, name) {"/" name, page_##number, page_##number##_end},
static const struct {
    const char *path;
    const uint8_t *begin, *end;
} files[] = {
#include "page_list.h"
};

static const char *type_of(const char *path)
{
    static const struct {
        const char *ending, *type;
    } types[] = {
        {".html", "text/html; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".svg", "image/svg+xml"},
    };
    const char *ending = strrchr(path, '.');

    for (size_t i = 0; ending != NULL && i < sizeof types / sizeof types[0]; i++)
        if (strcmp(ending, types[i].ending) == 0)
            return types[i].type;
    return "application/octet-stream";
}

bool page_file(const char *path, struct page_file *file)
{
    if (strcmp(path, "/") == 0)
        path = INDEX;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        if (strcmp(files[i].path, path) != 0)
            continue;
        *file = (struct page_file){
            .type = type_of(path),
            .bytes = files[i].begin,
            .count = (size_t)(files[i].end - files[i].begin),
        };
        return true;
    }
    return false;
}
