#include "tools/sweep/sweep.h"

bool sweep_stopped(const sweep_job *job) {
    return *job->interrupted != 0;
}

static bool go_on(void *user, double part) {
    (void)part;
    return !sweep_stopped(user);
}

bool sweep_show_progress(void *user, double part) {
    const sweep_job *job = user;
    progress_part(job->bench.progress, part);
    return !sweep_stopped(job);
}

lobe_render_parameters sweep_parameters(const sweep_job *job, const sweep_variant *variant) {
    return (lobe_render_parameters){
        .filter = variant->filter.filter,
        .settings = &variant->filter.settings,
        .width = job->bench.size[0],
        .height = job->bench.size[1],
        .reference.samples = BENCH_TIMED_SAMPLES,
        .discard = true,
        .host = {.progress = go_on, .user = (void *)job},
    };
}
