#include "passes/filters/displaced/window.h"

#include "passes/maps/level_reduction.h"

/// What Vulkan asks of every device: 65535 groups of threads, here of 64, one for each facet. In
/// buffers of 128 MiB each facet may then have 32 bytes, and at most 24 are needed (order 9).
uint64_t passes_window_limit(void) {
    return (uint64_t)65535 * 64;
}

/// Texels of the map, whole groups of 8 x 8 of them.
static uint32_t tile_extent(uint32_t extent, uint32_t count) {
    const uint32_t all = passes_half_extent(extent), each = (all + count - 1) / count;
    return count == 1 ? all : (each + 7) / 8 * 8;
}

static uint32_t window_extent(uint32_t extent, uint32_t count) {
    const uint32_t wide = 2 * tile_extent(extent, count) + 2 * WINDOW_MARGIN;
    return count == 1 || wide > extent ? extent : wide;
}

/// Tiles that are not empty.
static uint32_t tile_count(uint32_t extent, uint32_t count) {
    const uint32_t each = tile_extent(extent, count);
    return (passes_half_extent(extent) + each - 1) / each;
}

window_grid passes_window_grid(const device_map *heights, uint64_t most_facets) {
    window_grid grid = {heights->width, heights->height, 1, 1};
    while (2 * (uint64_t)window_extent(grid.relief_width, grid.columns) *
               window_extent(grid.relief_height, grid.rows) >
           most_facets) {
        const bool is_wide = tile_extent(grid.relief_width, grid.columns) >=
                             tile_extent(grid.relief_height, grid.rows);
        if (tile_extent(grid.relief_width, grid.columns) <= 8 &&
            tile_extent(grid.relief_height, grid.rows) <= 8)
            break;
        grid.columns += is_wide;
        grid.rows += !is_wide;
    }
    grid.columns = tile_count(grid.relief_width, grid.columns);
    grid.rows = tile_count(grid.relief_height, grid.rows);
    return grid;
}

/// Along one axis: where the window begins, its extent, and its first and number of texels.
typedef struct window_side {
    uint32_t first, extent, first_texel, texels;
} window_side;

static window_side side_of(uint32_t extent, uint32_t count, uint32_t index) {
    const uint32_t tile = tile_extent(extent, count), all = passes_half_extent(extent);
    window_side side = {.extent = window_extent(extent, count), .first_texel = index * tile};
    side.first = count == 1 ? 0 : (2 * side.first_texel + extent - WINDOW_MARGIN % extent) % extent;
    side.texels = all - side.first_texel < tile ? all - side.first_texel : tile;
    return side;
}

facet_window passes_window(const window_grid *grid, uint32_t index) {
    const window_side x = side_of(grid->relief_width, grid->columns, index % grid->columns),
                      y = side_of(grid->relief_height, grid->rows, index / grid->columns);
    return (facet_window){x.first,       y.first,       x.extent, y.extent,
                          x.first_texel, y.first_texel, x.texels, y.texels};
}

uint32_t passes_window_facets(const facet_window *window) {
    return 2 * window->width * window->height;
}

void passes_window_constants(const facet_window *window, struct transfer_constants *constants) {
    constants->width = window->width;
    constants->height = window->height;
    constants->origin_x = window->x;
    constants->origin_y = window->y;
    constants->first_column = window->first_column;
    constants->first_row = window->first_row;
}
