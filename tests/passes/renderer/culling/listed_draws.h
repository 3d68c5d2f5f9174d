#ifndef TESTS_PASSES_RENDERER_LISTED_DRAWS_H
#define TESTS_PASSES_RENDERER_LISTED_DRAWS_H

#include "passes/renderer/draw_list.h"
#include "tests/passes/support/pass_run.h"

/// Makes the draw list of a run's scene. `maps`: if `shared`, of each material; otherwise of each
/// instance. To be destroyed by passes_draw_list_destroy.
void list_draws(pass_run *run, draw_list *list, const filtered_appearance *maps, bool shared);

#endif
