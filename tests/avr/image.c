/* image.c: what is no image of Muster's is refused, with words. */
#include "chip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static char copy_path[] = "/tmp/muster-image-XXXXXX";
static char error[300];
static char *bytes;
static size_t size;

/* The image is read into memory; its copy in a file of its own is what a test damages. */
void setUp(void)
{
    FILE *file = fopen(chip_path, "rb");

    TEST_ASSERT_NOT_NULL(file);
    fseek(file, 0, SEEK_END);
    size = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(size);
    TEST_ASSERT_EQUAL(size, fread(bytes, 1, size, file));
    fclose(file);
    strcpy(copy_path + sizeof copy_path - 7, "XXXXXX");
    close(mkstemp(copy_path));
    error[0] = '\0';
}

void tearDown(void)
{
    unlink(copy_path);
    free(bytes);
}

static struct avr_image *open_copy(size_t length)
{
    FILE *file = fopen(copy_path, "wb");

    TEST_ASSERT_EQUAL(length, fwrite(bytes, 1, length, file));
    fclose(file);
    return avr_image_open(copy_path, error, sizeof error);
}

static void assert_refused(struct avr_image *image, const char *words)
{
    TEST_ASSERT_NULL(image);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, words), error);
}

static void test_an_image_is_opened(void)
{
    struct avr_image *image = open_copy(size);

    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    TEST_ASSERT_EQUAL_UINT32(PROTOCOL_VERSION, image->protocol);
    TEST_ASSERT_NOT_EQUAL(0, image->tick_cycles_max);
    avr_image_close(image);
}

static void test_a_missing_file_is_refused(void)
{
    assert_refused(avr_image_open("/nowhere/muster.elf", error, sizeof error),
                   "/nowhere/muster.elf: cannot be read");
}

static void test_what_is_no_elf_file_is_refused(void)
{
    memset(bytes, 'x', size);
    assert_refused(open_copy(size), "is no ELF file");
    assert_refused(open_copy(0), "is no ELF file");
    assert_refused(avr_image_open("/", error, sizeof error), "is no ELF file");
}

static void test_a_program_for_another_machine_is_refused(void)
{
    assert_refused(avr_image_open("/proc/self/exe", error, sizeof error), "is not for an AVR");
}

static void test_an_image_cut_short_is_refused(void)
{
    for (size_t length = 1; length < size; length += size / 97)
        TEST_ASSERT_NULL(open_copy(length));
}

static void test_an_image_without_the_symbols_is_refused(void)
{
    for (size_t i = 0; i + 11 < size; i++)
        if (memcmp(bytes + i, "muster_baud", 11) == 0)
            bytes[i] = 'M';
    assert_refused(open_copy(size), "muster_baud");
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_an_image_is_opened);
    RUN_TEST(test_a_missing_file_is_refused);
    RUN_TEST(test_what_is_no_elf_file_is_refused);
    RUN_TEST(test_a_program_for_another_machine_is_refused);
    RUN_TEST(test_an_image_cut_short_is_refused);
    RUN_TEST(test_an_image_without_the_symbols_is_refused);
    return UNITY_END();
}
