#include "markup.h"

#include <stdlib.h>
#include <unity.h>

static char *text;
static size_t length;
static FILE *out;

void setUp(void)
{
    out = open_memstream(&text, &length);
    TEST_ASSERT_NOT_NULL(out);
}

void tearDown(void)
{
    free(text);
}

static const char *written(void)
{
    fclose(out);
    return text;
}

static void html_has_its_signs_escaped(void)
{
    markup_text(out, "a < b && \"c\" > d, 5 \xce\xa9");
    TEST_ASSERT_EQUAL_STRING("a &lt; b &amp;&amp; &quot;c&quot; &gt; d, 5 \xce\xa9", written());
}

static void a_json_string_has_its_quotes_and_controls_escaped(void)
{
    markup_string(out, "say \"no\\yes\"\n\x1b");
    TEST_ASSERT_EQUAL_STRING("\"say \\\"no\\\\yes\\\"\\u000a\\u001b\"", written());
}

static void a_markdown_cell_stays_one(void)
{
    markup_cell(out, "|omega|\nin \\ rad");
    TEST_ASSERT_EQUAL_STRING("\\|omega\\| in \\\\ rad", written());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(html_has_its_signs_escaped);
    RUN_TEST(a_json_string_has_its_quotes_and_controls_escaped);
    RUN_TEST(a_markdown_cell_stays_one);
    return UNITY_END();
}
