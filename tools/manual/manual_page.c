// A subcommand's manual page, from its option table.

#include "tools/cli/subcommand.h"
#include "tools/manual/option_form.h"
#include "tools/manual/roff.h"

static void print_name(FILE *stream, const char *page, const char *summary) {
    roff_section(stream, "NAME");
    roff_text(stream, page);
    fputs(" \\- ", stream);
    roff_text(stream, summary);
    fputc('\n', stream);
}

static void print_synopsis(FILE *stream, const option_table *table) {
    roff_section(stream, "SYNOPSIS");
    fprintf(stream, "\\fB%s\\fR [\\fIOPTION\\fR]...", table->program);
    if (table->operands != NULL) {
        fputs(" \\fI", stream);
        roff_text(stream, table->operands);
        fputs("\\fR", stream);
    }
    fputc('\n', stream);
}

static void print_option(FILE *stream, const option *option) {
    char tag[64], limits[400], text[900];
    if (option->letter != '\0')
        snprintf(tag, sizeof tag, "-%c, --%s", option->letter, option->name);
    else
        snprintf(tag, sizeof tag, "--%s", option->name);
    option_print_limits(option, limits, sizeof limits);
    snprintf(text, sizeof text, "%s%s", option->summary, limits);
    roff_item(stream, tag, option->argument, text);
}

void manual_page_print(const option_table *table, FILE *stream) {
    const char *name = option_form_subcommand(table);
    char page[64];
    snprintf(page, sizeof page, "lobe-%s", name);
    roff_title(stream, page);
    print_name(stream, page, subcommand_find(name)->summary);
    print_synopsis(stream, table);
    roff_section(stream, "DESCRIPTION");
    roff_paragraphs(stream, table->summary);
    roff_section(stream, "OPTIONS");
    for (size_t index = 0; index < table->option_count; index++)
        print_option(stream, &table->options[index]);
    print_option(stream, &option_help);
    if (table->manual != NULL)
        table->manual(stream);
    roff_section(stream, "EXIT STATUS");
    fputs("0 done, 1 failed (a line on standard error says why), 2 wrong usage.\n", stream);
    roff_section(stream, "SEE ALSO");
    fputs(".BR lobe (1)\n", stream);
}
