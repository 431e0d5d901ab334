#include "qtm_names.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

static struct qtm_names names;

void setUp(void)
{
}

void tearDown(void)
{
}

static bool read_text(const char *text)
{
    qtm_names_begin(&names);
    qtm_names_take(&names, (const uint8_t *)text, strlen(text) + 1);
    return qtm_names_done(&names);
}

static void assert_names(const char *text, size_t count, const char *const *expected)
{
    TEST_ASSERT_TRUE_MESSAGE(read_text(text), text);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(count, names.count, text);
    for (size_t i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_STRING(expected[i], names.name[i]);
}

/* As versions up to 1.20 tell it. */
static const char older[] =
    "<QTM_Parameters_Ver_1.18>\n <The_6D>\n  <Bodies>2</Bodies>\n"
    "  <Body>\n   <Name>robot 1</Name>\n   <RGBColor>65280</RGBColor>\n"
    "   <Point>\n    <X>1</X>\n   </Point>\n  </Body>\n"
    "  <Body>\n   <Name>robot 2</Name>\n  </Body>\n"
    "  <Euler>\n   <First>Z</First>\n  </Euler>\n </The_6D>\n</QTM_Parameters_Ver_1.18>\n";

/* As later ones do: other things have names too. */
static const char later[] =
    "<?xml version=\"1.0\"?><!-- <Name>no</Name> - > -->\n"
    "<QTM_Parameters_Ver_1.28><Other><Body><Name>no</Name></Body></Other>"
    "<The_6D unit='<mm>'><Body><Name> robot &lt;1&gt; </Name><Enabled>true</Enabled>"
    "<Color R=\"1\" G='/>' /><Mesh><Name>no</Name></Mesh>"
    "<Points><Point X=\"1\" Name=\"no\"/></Points></Body>"
    "<Body><Mesh><Name>no</Name></Mesh><Name>robot&amp;2</Name></Body><Body/>"
    "<Body><Name/></Body></The_6D></QTM_Parameters_Ver_1.28>";

static void test_names(void)
{
    assert_names(older, 2, (const char *const[]){"robot 1", "robot 2"});
    assert_names(later, 4, (const char *const[]){"robot <1>", "robot&2", "", ""});
    assert_names("<a><The_6D></The_6D></a>", 0, NULL);
    assert_names("<a><The_6D><Body><Name>ro<b>no<c/></b>bot</Name></Body></The_6D></a>", 1,
                 (const char *const[]){"robot"});
}

static void test_any_pieces(void)
{
    for (size_t cut = 0; cut < sizeof later; cut++) {
        qtm_names_begin(&names);
        qtm_names_take(&names, (const uint8_t *)later, cut);
        TEST_ASSERT_FALSE(cut > 0 && cut < sizeof later - 1 && names.depth == 0 &&
                          qtm_names_done(&names));
        qtm_names_take(&names, (const uint8_t *)later + cut, sizeof later - cut);
        TEST_ASSERT_TRUE(qtm_names_done(&names));
        TEST_ASSERT_EQUAL_STRING("robot <1>", names.name[0]);
        TEST_ASSERT_EQUAL_STRING("robot&2", names.name[1]);
    }
}

static void test_long_names_are_cut(void)
{
    char text[300];

    snprintf(text, sizeof text, "<a><The_6D><Body><Name>%0100d</Name></Body></The_6D></a>", 7);
    TEST_ASSERT_TRUE(read_text(text));
    TEST_ASSERT_EQUAL_UINT(CAPTURE_NAME_MAX - 1, strlen(names.name[0]));
}

static void test_what_is_refused(void)
{
    static const char *const wrong[] = {
        "",
        "names",
        "<a>",
        "<a></a></a>",
        "<a><The_6D><Body><Name>robot</Name></Body></The_6D>",
        "<a><The_6D><Body><Name>&other;</Name></Body></The_6D></a>",
        "<!DOCTYPE a [<!ENTITY x \"y\">]><a></a>",
        "< a></a>",
        "<></>",
    };

    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        TEST_ASSERT_FALSE_MESSAGE(read_text(wrong[i]), wrong[i]);
}

static void take_text(const char *text)
{
    qtm_names_take(&names, (const uint8_t *)text, strlen(text));
}

static void test_limits(void)
{
    qtm_names_begin(&names);
    take_text("<a><The_6D>");
    for (int i = 0; i < CAPTURE_BODIES_MAX; i++)
        take_text("<Body><Name>robot</Name></Body>");
    TEST_ASSERT_FALSE(names.failed);
    take_text("<Body>");
    TEST_ASSERT_TRUE(names.failed);

    qtm_names_begin(&names);
    for (int i = 0; i < 65; i++)
        take_text("<a>");
    TEST_ASSERT_TRUE(names.failed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names);
    RUN_TEST(test_any_pieces);
    RUN_TEST(test_long_names_are_cut);
    RUN_TEST(test_what_is_refused);
    RUN_TEST(test_limits);
    return UNITY_END();
}
