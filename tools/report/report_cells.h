#ifndef TOOLS_REPORT_REPORT_CELLS_H
#define TOOLS_REPORT_REPORT_CELLS_H

#include <stddef.h>
#include <stdio.h>

/// Cells of the report's tables. Text is given unescaped.

/// A number as people read it, with all its digits for programs.
void report_number(FILE *page, double value, int significant);
void report_number_cell(FILE *page, double value, int significant);
void report_text_cell(FILE *page, const char *text);

/// Heads a row: a filter with its key.
void report_filter_head(FILE *page, const char *name, size_t index);
/// Heads a row.
void report_head_cell(FILE *page, const char *text);

/// Opens a table in a box that scrolls where it is too wide; `head` is HTML, its rows.
/// report_table_end closes both.
void report_table_begin(FILE *page, const char *caption, const char *head);
void report_table_end(FILE *page);

#endif
