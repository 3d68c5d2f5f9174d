#include "tools/report/report.h"

static const char guide[] =
    "<section id=\"guide\"><h2>How to read this</h2>\n<dl>\n"
    "<dt>error</dt><dd>Compares a still picture with the reference, the same scene at many samples "
    "a pixel, in linear radiance. <em>Relative L2</em> is the length of the difference over the "
    "length of the reference, |a − r| / |r| over all pixels; <em>relative L1</em> likewise "
    "with sums of absolute values. <em>FLIP</em> (Andersson et al. 2021) is what a person sees who "
    "flips between both, from 0 to 1. <em>Lobes as base</em> compares with a reference whose base "
    "lobes were first turned into those that the filters work with: what is left is the error of "
    "filtering.</dd>\n"
    "<dt>flicker</dt><dd>Along the scene’s camera path, how much more a picture changes "
    "from frame to frame than the reference does: |(a′ − a) − (r′ − r)| / |r|, "
    "relative L2 over all pairs of frames. Measured against two references with noise of their "
    "own, which falls out.</dd>\n"
    "<dt>time</dt><dd>Milliseconds of a frame on the device, the median over many frames; the "
    "filters took turns, so that what disturbs the machine disturbs all. <em>Maps rebuilt</em>: "
    "every map of the filter is built again in the frame. <em>Maps retained</em>: the maps are "
    "there already.</dd>\n"
    "<dt>bytes a texel</dt><dd>Memory of the maps that a filter builds, with all their levels, for "
    "each texel of the maps that they are built from; 0 where it builds none.</dd>\n"
    "<dt>Pareto front</dt><dd>The choices that no other beats: whatever costs less is more wrong. "
    "They are ringed, numbered from left to right and joined by steps; a list below each plot "
    "names them.</dd>\n"
    "<dt>large and small marks</dt><dd>A large mark is a filter at its defaults. A small hollow "
    "one "
    "is the same filter with one knob turned, joined to it by a thin line.</dd>\n"
    "</dl></section>\n";

void report_write_guide(const report *report) {
    fputs(guide, report->page);
}
