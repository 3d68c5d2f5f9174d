// The check of JSON text that precedes parsing.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "scenes/gltf/json.h"

typedef struct outcome {
    size_t errors;
    char message[512];
    char visited[512];
} outcome;

static void on_log(void *user, lobe_log_level level, const char *message) {
    outcome *o = user;
    assert_int_equal(level, LOBE_LOG_ERROR);
    o->errors++;
    snprintf(o->message, sizeof o->message, "%s", message);
}

static lobe_result visit(void *user, const char *text) {
    outcome *o = user;
    size_t length = strlen(o->visited);
    snprintf(o->visited + length, sizeof o->visited - length, "<%s>", text);
    return strcmp(text, "stop") == 0 ? LOBE_ERROR_UNSUPPORTED : LOBE_OK;
}

static const json_schema integer = {.kind = JSON_INDEX};
static const json_schema size = {.kind = JSON_SIZE};
static const json_schema number = {.kind = JSON_NUMBER};
static const json_schema boolean = {.kind = JSON_BOOLEAN};
static const json_schema text = {.kind = JSON_STRING, .visit = visit};
static const json_schema pair = {.kind = JSON_ARRAY, .element = &number, .length = 2};
static const json_schema filled = {.kind = JSON_ARRAY, .element = &number, .filled = true};
static const json_schema named = {.kind = JSON_OBJECT, .element = &integer};
static const json_schema item = {
    .kind = JSON_OBJECT,
    .members =
        (const json_member[]){{"i", &integer, true}, {"t", &text, false}, {NULL, NULL, false}}};
static const json_schema items = {.kind = JSON_ARRAY, .element = &item};
static const json_schema root = {.kind = JSON_OBJECT,
                                 .members = (const json_member[]){{"items", &items, false},
                                                                  {"s", &size, false},
                                                                  {"b", &boolean, false},
                                                                  {"p", &pair, false},
                                                                  {"f", &filled, false},
                                                                  {"t", &text, false},
                                                                  {"named", &named, false},
                                                                  {NULL, NULL, false}}};

static lobe_result check_bytes(const char *bytes, size_t length, outcome *o) {
    *o = (outcome){0};
    lobe_host host = {.write = on_log, .user = o};
    json_text content = {"file", bytes, length, &host, o};
    lobe_result result = scenes_json_check(&content, &root);
    if (result == LOBE_OK || result == LOBE_ERROR_UNSUPPORTED)
        assert_int_equal(o->errors, 0);
    else
        assert_int_equal(o->errors, 1);
    return result;
}

static void assert_accepts(const char *json) {
    outcome o;
    if (check_bytes(json, strlen(json), &o) != LOBE_OK)
        fail_msg("%s: %s", json, o.message);
}

static void assert_refuses(const char *json, const char *message) {
    outcome o;
    assert_int_equal(check_bytes(json, strlen(json), &o), LOBE_ERROR_MALFORMED);
    assert_string_equal(o.message, message);
}

static void valid_text_is_accepted(void **state) {
    (void)state;
    assert_accepts("{}");
    assert_accepts(" \r\n\t{ \"a\" : [ ] , \"b\" : true } ");
    assert_accepts("{\"x\":[1,-1,0,-0,1.5,1e9,1E+9,2.5e-3,null,false,\"\",{\"y\":{}}]}");
    assert_accepts("{\"x\":\"\\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e9\\uD83D\"}");
    assert_accepts("{\"items\":[{\"i\":0},{\"i\":2147483646,\"t\":\"a\"}],\"s\":9007199254740992,"
                   "\"p\":[1,2e0],\"f\":[3],\"named\":{\"any\":7}}");
}

static void wrong_types_are_named_with_their_place(void **state) {
    (void)state;
    assert_refuses("[]", "file: line 1: an object expected");
    assert_refuses("{\"items\":{}}", "file: line 1: items: an array expected");
    assert_refuses("{\n\"items\":[\n{\"i\":1},\n{\"i\":\"1\"}]}",
                   "file: line 4: items[1].i: an integer expected");
    assert_refuses("{\"items\":[{}]}", "file: line 1: items[0]: 'i' is missing");
    assert_refuses("{\"items\":[{\"i\":-1}]}",
                   "file: line 1: items[0].i: a non-negative integer expected");
    assert_refuses("{\"items\":[{\"i\":1.0}]}",
                   "file: line 1: items[0].i: a non-negative integer expected");
    assert_refuses("{\"items\":[{\"i\":1e2}]}",
                   "file: line 1: items[0].i: a non-negative integer expected");
    assert_refuses("{\"items\":[{\"i\":2147483647}]}",
                   "file: line 1: items[0].i: the integer is too large");
    assert_refuses("{\"s\":9007199254740993}", "file: line 1: s: the integer is too large");
    assert_refuses("{\"s\":99999999999999999999999999}",
                   "file: line 1: s: the integer is too large");
    assert_refuses("{\"b\":0}", "file: line 1: b: true or false expected");
    assert_refuses("{\"b\":null}", "file: line 1: b: true or false expected");
    assert_refuses("{\"p\":[1]}", "file: line 1: p: 2 elements expected, 1 found");
    assert_refuses("{\"f\":[]}", "file: line 1: f: an element expected, none found");
    assert_refuses("{\"p\":[1,\"\"]}", "file: line 1: p[1]: a number expected");
    assert_refuses("{\"named\":{\"x\":[]}}", "file: line 1: named.x: an integer expected");
}

static void escaped_names_are_the_same_names(void **state) {
    (void)state;
    assert_refuses("{\"\\u0062\":0}", "file: line 1: b: true or false expected");
}

static void faults_of_syntax_are_found(void **state) {
    (void)state;
    static const char *const bad[] = {
        "",
        "{",
        "{\"",
        "{\"a",
        "{\"a\"",
        "{\"a\":",
        "{\"a\":1",
        "{\"a\":1,",
        "{\"a\":1,}",
        "{,}",
        "{\"a\" 1}",
        "{a:1}",
        "{}{}",
        "{\"a\":[1",
        "{\"a\":[1,]}",
        "{\"a\":tru}",
        "{\"a\":nul}",
        "{\"a\":+1}",
        "{\"a\":.5}",
        "{\"a\":5.}",
        "{\"a\":1e}",
        "{\"a\":01}",
        "{\"a\":-}",
        "{\"a\":0x1}",
        "{\"a\":NaN}",
        "{\"a\":\"\\x\"}",
        "{\"a\":\"\\u12g4\"}",
        "{\"a\":\"\n\"}",
        "\"a",
        "{\"a\":'b'}",
        "{]",
        "{\"a\":[}",
        "// {}",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        outcome o;
        if (check_bytes(bad[i], strlen(bad[i]), &o) != LOBE_ERROR_MALFORMED)
            fail_msg("accepted: %s", bad[i]);
    }
    outcome o;
    assert_int_equal(check_bytes("{\"a\0b\":1}", 9, &o), LOBE_ERROR_MALFORMED);
}

// Every proper prefix of a valid text is invalid, and is not read past its end.
static void every_truncation_is_refused(void **state) {
    (void)state;
    static const char json[] =
        "{\"items\":[{\"i\":12,\"t\":\"\\u0041\\n\"}],\"p\":[1.5e-3,-2],\"b\":false,\"x\":null}";
    for (size_t length = 0; length + 1 < sizeof json; length++) {
        char copy[sizeof json];
        memcpy(copy, json, length);
        memset(copy + length, '9', sizeof copy - length);
        outcome o;
        assert_int_equal(check_bytes(copy, length, &o), LOBE_ERROR_MALFORMED);
    }
    assert_accepts(json);
}

static void nesting_is_limited(void **state) {
    (void)state;
    char deep[16 + 2 * JSON_MAXIMUM_DEPTH];
    for (size_t depth = JSON_MAXIMUM_DEPTH - 2; depth < JSON_MAXIMUM_DEPTH + 1; depth++) {
        strcpy(deep, "{\"a\":");
        memset(deep + 5, '[', depth);
        memset(deep + 5 + depth, ']', depth);
        strcpy(deep + 5 + 2 * depth, "}");
        outcome o;
        lobe_result expected = depth < JSON_MAXIMUM_DEPTH ? LOBE_OK : LOBE_ERROR_MALFORMED;
        assert_int_equal(check_bytes(deep, strlen(deep), &o), expected);
    }
}

static void strings_are_visited_until_one_is_refused(void **state) {
    (void)state;
    outcome o;
    const char json[] = "{\"t\":\"a\\tb\",\"items\":[{\"i\":1,\"t\":\"stop\"},{\"t\":\"c\"}]}";
    assert_int_equal(check_bytes(json, strlen(json), &o), LOBE_ERROR_UNSUPPORTED);
    assert_string_equal(o.visited, "<a\tb><stop>");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valid_text_is_accepted),
        cmocka_unit_test(wrong_types_are_named_with_their_place),
        cmocka_unit_test(escaped_names_are_the_same_names),
        cmocka_unit_test(faults_of_syntax_are_found),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(nesting_is_limited),
        cmocka_unit_test(strings_are_visited_until_one_is_refused),
    };
    return cmocka_run_group_tests_name("JSON", tests, NULL, NULL);
}
