#include "tools/report_rows.h"

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
    for (size_t i = 0; row->varied[0] != '\0' && i < row->setting_count; ++i) {
        if (strcmp(row->settings[i].name, row->varied) == 0)
            return row->settings[i].value;
    }
    return row->varied[0] != '\0' ? "?" : NULL;
}
