#include "tools/choice/filter_choice.h"

option filter_option_set(option_list *assignments) {
    return (option){
        .name = "set",
        .kind = OPTION_LIST,
        .argument = "KNOB=VALUE",
        .summary = "set a knob of the filter, see 'lobe filters'",
        .target = assignments,
        .values = OPTION_VALUES_KNOB,
    };
}

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
