#include "tools/cli/options.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/closest_name.h"

// ---------------------------------------------------------------------------------------------
// Values

bool option_parse_numbers(const char *text, size_t count, double *values) {
    for (size_t index = 0; index < count; index++) {
        char *end;
        // strtod also accepts leading white space, hexadecimal digits and names.
        size_t length = strspn(text, "0123456789+-.eE");
        values[index] = strtod(text, &end);
        char expected = index + 1 < count ? ',' : '\0';
        if (length == 0 || end != text + length || *end != expected || !isfinite(values[index]))
            return false;
        text = end + 1;
    }
    return true;
}

bool option_parse_number(const char *text, double *value) {
    return option_parse_numbers(text, 1, value);
}

/// Digits only, so that signs and hexadecimal are rejected. Moves `*text` past them.
static bool parse_digits(const char **text, uint32_t *value) {
    uint64_t sum = 0;
    const char *digit = *text;
    for (; *digit >= '0' && *digit <= '9'; digit++) {
        sum = 10 * sum + (uint64_t)(*digit - '0');
        if (sum > UINT32_MAX)
            return false;
    }
    bool any = digit != *text;
    *text = digit;
    *value = (uint32_t)sum;
    return any;
}

static bool parse_integer(const char *text, uint32_t *value) {
    return parse_digits(&text, value) && *text == '\0';
}

static bool parse_size(const char *text, uint32_t size[2]) {
    return parse_digits(&text, &size[0]) && *text++ == 'x' && parse_integer(text, &size[1]);
}

static bool in_range(const option *option, double value) {
    return option->minimum == option->maximum ||
           (value >= option->minimum && value <= option->maximum);
}

void option_list_free(option_list *list) {
    if (list == NULL)
        return;
    free(list->values);
    *list = (option_list){0};
}

static bool list_append(option_list *list, const char *text) {
    const char **values = realloc(list->values, (list->count + 1) * sizeof *values);
    if (values == NULL)
        return false;
    values[list->count++] = text;
    list->values = values;
    return true;
}

// ---------------------------------------------------------------------------------------------
// Messages

static void print_mistake(const option_table *table, const char *format, va_list arguments) {
    fprintf(stderr, "%s: ", table->program);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, " (see '%s --help')\n", table->program);
}

int options_usage_error(const option_table *table, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_mistake(table, format, arguments);
    va_end(arguments);
    return 2;
}

static int out_of_memory(const option_table *table) {
    fprintf(stderr, "%s: out of memory\n", table->program);
    return 1;
}

static void describe_range(const option *option, char *text, size_t size) {
    if (option->minimum == option->maximum)
        text[0] = '\0';
    else if (option->kind == OPTION_SIZE)
        snprintf(text, size, "[%.0fx%.0f, %.0fx%.0f]", option->minimum, option->minimum,
                 option->maximum, option->maximum);
    else
        snprintf(text, size, "[%.10g, %.10g]", option->minimum, option->maximum);
}

static int bad_value(const option_table *table, const option *option, const char *text,
                     const char *expected) {
    return options_usage_error(table, "--%s: '%s' is not %s", option->name, text, expected);
}

static int out_of_range(const option_table *table, const option *option, const char *text) {
    char range[96];
    describe_range(option, range, sizeof range);
    return options_usage_error(table, "--%s: %s is outside %s", option->name, text, range);
}

// ---------------------------------------------------------------------------------------------
// Storing. Each function returns 0 or the exit status.

static int store_integer(const option_table *table, const option *option, const char *text) {
    uint32_t value;
    if (!parse_integer(text, &value))
        return bad_value(table, option, text, "a whole number");
    if (!in_range(option, value))
        return out_of_range(table, option, text);
    *(uint32_t *)option->target = value;
    return 0;
}

static int store_number(const option_table *table, const option *option, const char *text) {
    double value;
    if (!option_parse_number(text, &value))
        return bad_value(table, option, text, "a number");
    if (!in_range(option, value))
        return out_of_range(table, option, text);
    *(double *)option->target = value;
    return 0;
}

static int store_size(const option_table *table, const option *option, const char *text) {
    uint32_t size[2];
    if (!parse_size(text, size))
        return bad_value(table, option, text, "WIDTHxHEIGHT in whole numbers");
    if (!in_range(option, size[0]) || !in_range(option, size[1]))
        return out_of_range(table, option, text);
    memcpy(option->target, size, sizeof size);
    return 0;
}

static int store_vector(const option_table *table, const option *option, const char *text) {
    double values[3];
    if (!option_parse_numbers(text, 3, values))
        return bad_value(table, option, text, "three numbers x,y,z");
    for (size_t index = 0; index < 3; index++) {
        if (!in_range(option, values[index]) || !isfinite((float)values[index]))
            return out_of_range(table, option, text);
        ((float *)option->target)[index] = (float)values[index];
    }
    return 0;
}

static void join_choices(const option *option, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (size_t index = 0; option->choices[index] != NULL && used < size; index++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", index > 0 ? ", " : "",
                                 option->choices[index]);
}

static int store_choice(const option_table *table, const option *option, const char *text) {
    for (uint32_t index = 0; option->choices[index] != NULL; index++) {
        if (strcmp(option->choices[index], text) == 0) {
            *(uint32_t *)option->target = index;
            return 0;
        }
    }
    char names[256], expected[272];
    join_choices(option, names, sizeof names);
    snprintf(expected, sizeof expected, "one of %s", names);
    return bad_value(table, option, text, expected);
}

static int store(const option_table *table, const option *option, const char *text) {
    switch (option->kind) {
    case OPTION_FLAG:
        *(bool *)option->target = true;
        return 0;
    case OPTION_TEXT:
        *(const char **)option->target = text;
        return 0;
    case OPTION_INTEGER:
        return store_integer(table, option, text);
    case OPTION_NUMBER:
        return store_number(table, option, text);
    case OPTION_SIZE:
        return store_size(table, option, text);
    case OPTION_VECTOR:
        return store_vector(table, option, text);
    case OPTION_CHOICE:
        return store_choice(table, option, text);
    case OPTION_LIST:
        return list_append(option->target, text) ? 0 : out_of_memory(table);
    }
    return 0;
}

// ---------------------------------------------------------------------------------------------
// Parsing

static option_form *(*find_form)(const char *name);

void options_set_form_finder(option_form *(*find)(const char *name)) {
    find_form = find;
}

typedef struct parser {
    const option_table *table;
    char **argv;
    int argc, next; ///< argv[next] is read next
    bool *seen;     ///< for each option of the table
    option_list *operands;
    option_form *help; ///< NULL: not requested
} parser;

static const option *find_by_name(const option_table *table, const char *name, size_t length) {
    for (size_t index = 0; index < table->option_count; index++) {
        const char *candidate = table->options[index].name;
        if (strlen(candidate) == length && memcmp(candidate, name, length) == 0)
            return &table->options[index];
    }
    return NULL;
}

static const option *find_by_letter(const option_table *table, char letter) {
    for (size_t index = 0; index < table->option_count; index++) {
        if (letter != '\0' && table->options[index].letter == letter)
            return &table->options[index];
    }
    return NULL;
}

/// `value` is the value in the same argument; NULL: it is the next argument.
static int take_value(parser *parser, const option *option, const char *value) {
    parser->seen[option - parser->table->options] = true;
    if (option->kind == OPTION_FLAG) {
        if (value != NULL)
            return options_usage_error(parser->table, "--%s takes no value", option->name);
        return store(parser->table, option, NULL);
    }
    if (value == NULL && parser->next < parser->argc)
        value = parser->argv[parser->next++];
    if (value == NULL)
        return options_usage_error(parser->table, "--%s needs a value (%s)", option->name,
                                   option->argument);
    return store(parser->table, option, value);
}

/// `equals` is the end of "--help=FORM", or NULL.
static int ask_for_help(parser *parser, const char *equals) {
    if (equals == NULL)
        parser->help = options_print_help;
    else
        parser->help = find_form != NULL ? find_form(equals + 1) : NULL;
    return parser->help != NULL
               ? 0
               : options_usage_error(parser->table, "--help: there is no form '%s'", equals + 1);
}

static int unknown_option(const option_table *table, const char *name, size_t length) {
    closest_name closest = {.name = name, .length = length};
    char hint[CLOSEST_NAME_HINT_SIZE];
    for (size_t index = 0; index < table->option_count; index++)
        closest_name_offer(&closest, table->options[index].name);
    closest_name_offer(&closest, option_help.name);
    return options_usage_error(table, "unknown option --%.*s%s", (int)length, name,
                               closest_name_hint(&closest, "--", hint));
}

static int parse_long(parser *parser, const char *text) {
    const char *equals = strchr(text, '=');
    size_t length = equals != NULL ? (size_t)(equals - text) : strlen(text);
    if (length == 4 && memcmp(text, "help", 4) == 0)
        return ask_for_help(parser, equals);
    const option *option = find_by_name(parser->table, text, length);
    if (option == NULL)
        return unknown_option(parser->table, text, length);
    return take_value(parser, option, equals != NULL ? equals + 1 : NULL);
}

static int parse_short(parser *parser, const char *text) {
    const option *option = find_by_letter(parser->table, text[0]);
    if (option == NULL)
        return options_usage_error(parser->table, "unknown option -%s", text);
    return take_value(parser, option, text[1] != '\0' ? text + 1 : NULL);
}

static int parse_operand(parser *parser, const char *text) {
    size_t count = parser->operands != NULL ? parser->operands->count : 0;
    if (count >= parser->table->maximum_operands)
        return options_usage_error(parser->table, "unexpected operand '%s'", text);
    return list_append(parser->operands, text) ? 0 : out_of_memory(parser->table);
}

static int parse_arguments(parser *parser) {
    bool options_ended = false;
    int status = 0;
    while (status == 0 && !parser->help && parser->next < parser->argc) {
        const char *text = parser->argv[parser->next++];
        if (options_ended || text[0] != '-' || text[1] == '\0')
            status = parse_operand(parser, text);
        else if (strcmp(text, "--") == 0)
            options_ended = true;
        else if (text[1] == '-')
            status = parse_long(parser, text + 2);
        else
            status = parse_short(parser, text + 1);
    }
    return status;
}

/// Sets the `given` flags, and fills the options not given from their fallbacks.
static int complete(parser *parser) {
    int status = 0;
    for (size_t index = 0; status == 0 && index < parser->table->option_count; index++) {
        const option *option = &parser->table->options[index];
        if (option->given != NULL)
            *option->given = parser->seen[index];
        if (!parser->seen[index] && option->fallback != NULL)
            status = store(parser->table, option, option->fallback);
    }
    return status;
}

static int check_operand_count(const parser *parser) {
    size_t count = parser->operands != NULL ? parser->operands->count : 0;
    if (count < parser->table->minimum_operands)
        return options_usage_error(parser->table, "operands are missing: %s",
                                   parser->table->operands);
    return 0;
}

bool options_parse(const option_table *table, int argc, char **argv, option_list *operands,
                   int *status) {
    parser parser = {table, argv, argc, 1, NULL, operands, NULL};
    parser.seen = calloc(table->option_count + 1, sizeof *parser.seen);
    if (parser.seen == NULL) {
        *status = out_of_memory(table);
        return false;
    }
    *status = parse_arguments(&parser);
    if (*status == 0 && parser.help)
        parser.help(table, stdout);
    if (*status == 0 && !parser.help)
        *status = check_operand_count(&parser);
    if (*status == 0 && !parser.help)
        *status = complete(&parser);
    free(parser.seen);
    return *status == 0 && !parser.help;
}

void options_free(const option_table *table, option_list *operands) {
    option_list_free(operands);
    for (size_t index = 0; index < table->option_count; index++) {
        if (table->options[index].kind == OPTION_LIST)
            option_list_free(table->options[index].target);
    }
}

// ---------------------------------------------------------------------------------------------
// Help

enum { HELP_INDENT = 28, HELP_WIDTH = 88 };

/// Prints words from column `column` on, wrapped before HELP_WIDTH, with later lines indented.
static void print_wrapped(FILE *stream, const char *text, size_t column) {
    while (*text != '\0') {
        size_t length = strcspn(text, " ");
        if (column > HELP_INDENT && column + 1 + length > HELP_WIDTH) {
            fprintf(stream, "\n%*s", HELP_INDENT, "");
            column = HELP_INDENT;
        } else if (column > HELP_INDENT) {
            fputc(' ', stream);
            column++;
        }
        fprintf(stream, "%.*s", (int)length, text);
        column += length;
        text += length + strspn(text + length, " ");
    }
    fputc('\n', stream);
}

void option_print_limits(const option *option, char *text, size_t size) {
    char range[96], names[256] = "";
    describe_range(option, range, sizeof range);
    if (option->kind == OPTION_CHOICE)
        join_choices(option, names, sizeof names);
    snprintf(text, size, "%s%s%s%s%s%s%s%s", range[0] != '\0' ? " " : "", range,
             names[0] != '\0' ? ": " : "", names,
             option->kind == OPTION_LIST ? " (may be repeated)" : "",
             option->fallback != NULL ? " (default " : "",
             option->fallback != NULL ? option->fallback : "", option->fallback != NULL ? ")" : "");
}

static void print_option_help(FILE *stream, const option *option) {
    char start[64], limits[400], words[768];
    char letter[5] = "    ";
    if (option->letter != '\0')
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    int used = snprintf(start, sizeof start, "  %s--%s%s%s", letter, option->name,
                        option->argument != NULL ? " " : "",
                        option->argument != NULL ? option->argument : "");
    fputs(start, stream);
    if (used + 1 >= HELP_INDENT)
        fprintf(stream, "\n%*s", HELP_INDENT, "");
    else
        fprintf(stream, "%*s", HELP_INDENT - used, "");
    option_print_limits(option, limits, sizeof limits);
    snprintf(words, sizeof words, "%s%s", option->summary, limits);
    print_wrapped(stream, words, HELP_INDENT);
}

const option option_help = {.name = "help", .summary = "show this help"};

void options_print_help(const option_table *table, FILE *stream) {
    fprintf(stream, "Usage: %s [OPTION]...%s%s\n\n%s\n\nOptions:\n", table->program,
            table->operands != NULL ? " " : "", table->operands != NULL ? table->operands : "",
            table->summary);
    for (size_t index = 0; index < table->option_count; index++)
        print_option_help(stream, &table->options[index]);
    print_option_help(stream, &option_help);
}
