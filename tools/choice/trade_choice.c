#include "tools/choice/trade_choice.h"

#include <math.h>

typedef struct trade_cost {
    double limited, wanted;
} trade_cost;

double trade_milliseconds(const trade_request *request, const sweep_row *row) {
    if (request->retained)
        return row->retained_ms * request->pixels;
    if (request->pixels == 1)
        return row->rebuilt_ms;
    return row->building_ms + row->shading_ms * request->pixels;
}

static trade_cost cost_of(const trade_request *request, const sweep_row *row) {
    const double milliseconds = trade_milliseconds(request, row);
    const double error = row->error.relative_l2;
    return request->kind == TRADE_LIMIT_MILLISECONDS ? (trade_cost){milliseconds, error}
                                                     : (trade_cost){error, milliseconds};
}

/// Devices without timestamps leave times at 0; values that could not be measured are NAN.
static bool is_candidate(const trade_request *request, const sweep_row *row) {
    const double milliseconds = trade_milliseconds(request, row);
    const double error = row->error.relative_l2;
    return isfinite(milliseconds) && milliseconds > 0 && isfinite(error) && error >= 0;
}

/// By the limited cost first, then by the wanted one.
static bool costs_less(trade_cost a, trade_cost b) {
    return a.limited != b.limited ? a.limited < b.limited : a.wanted < b.wanted;
}

/// The other way round.
static bool is_better(trade_cost a, trade_cost b) {
    return a.wanted != b.wanted ? a.wanted < b.wanted : a.limited < b.limited;
}

static void consider(const trade_request *request, const sweep_row *row, trade_choice *choice) {
    const trade_cost cost = cost_of(request, row);
    ++choice->candidates;
    if (!choice->nearest || costs_less(cost, cost_of(request, choice->nearest)))
        choice->nearest = row;
    if (!(cost.limited <= request->limit))
        return;
    ++choice->within;
    if (!choice->picked || is_better(cost, cost_of(request, choice->picked)))
        choice->picked = row;
}

static void consider_better(const trade_request *request, const sweep_row *row,
                            trade_choice *choice) {
    const trade_cost cost = cost_of(request, row);
    if (cost.wanted < cost_of(request, choice->picked).wanted &&
        (!choice->better || costs_less(cost, cost_of(request, choice->better))))
        choice->better = row;
}

trade_choice trade_choose(const trade_request *request, const sweep_row *const *rows,
                          size_t count) {
    trade_choice choice = {0};
    for (size_t i = 0; i < count; i++) {
        if (is_candidate(request, rows[i]))
            consider(request, rows[i], &choice);
    }
    for (size_t i = 0; choice.picked && i < count; i++) {
        if (is_candidate(request, rows[i]))
            consider_better(request, rows[i], &choice);
    }
    return choice;
}
