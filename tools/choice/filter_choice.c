#include "tools/choice/filter_choice.h"

int filter_choice_make(const char *name, const option_list *assignments, const lobe_host *host,
                       const lobe_filter **filter, lobe_settings *settings) {
    if (lobe_filter_find(name, host, filter) != LOBE_OK)
        return 2;
    lobe_settings_default(*filter, settings);
    for (size_t i = 0; i < assignments->count; i++)
        if (lobe_settings_set(*filter, settings, assignments->values[i], host) != LOBE_OK)
            return 2;
    return 0;
}
