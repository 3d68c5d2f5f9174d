#include "tools/report/report_rows.h"

#include <string.h>

size_t report_count_rows(const sweep_results *results, const char *scene) {
    size_t count = 0;
    for (size_t i = 0; i < results->row_count; ++i)
        count += strcmp(results->rows[i].scene, scene) == 0;
    return count;
}

bool report_is_far(const char *filter) {
    return strcmp(filter, "reference") == 0;
}

const char *report_varied_value(const sweep_row *row) {
    if (row->varied[0] == '\0')
        return NULL;
    const char *value = sweep_row_value(row, row->varied);
    return value ? value : "?";
}

const char *const report_methods[REPORT_METHODS] = {"prefiltered", "mip", "sampled"};

size_t report_method(const sweep_row *row) {
    const char *value = sweep_row_value(row, "env");
    for (size_t i = 0; value && i < REPORT_METHODS; ++i) {
        if (strcmp(report_methods[i], value) == 0)
            return i;
    }
    return 0;
}
