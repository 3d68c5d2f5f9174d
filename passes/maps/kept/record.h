#ifndef PASSES_MAPS_KEPT_RECORD_H
#define PASSES_MAPS_KEPT_RECORD_H

#include "passes/context/filter.h"
#include "passes/maps/kept/restoring.h"
#include "passes/maps/kept/subject.h"

/// What is kept, from frame to frame, of maps of a material that take seconds to make, in a
/// filter's slot: how much of them is made, and what a cache folder has of them. Texels that
/// replace others are taken in one frame, and not saved: they may change again in the next.

typedef struct kept_record kept_record;

/// For lobe_filter.prepare of a filter that adapts to texels: looks for the maps in the frame's
/// cache folder when they are first needed, and takes as much of the frame's work as is left to do.
/// Where frames make a share of the work, the subject is that of the share.
lobe_result passes_kept_prepare(const filter_context *context, uint32_t material,
                                const kept_subject *subject, void **slot);
/// For lobe_filter.forget.
void passes_kept_forget(void *slot);
/// For lobe_filter.save: saves what the frame read back, and frees what it has placed.
void passes_kept_save(void *slot, const lobe_graph *graph, const char *folder,
                      const lobe_host *host);

/// Parts that are to be made until this frame's end, of the tiles that the folder did not have.
/// UINT32_MAX, and `*in_parts` false: all at once. `record`: what the slot holds, or NULL.
uint32_t passes_kept_parts(const filter_context *context, const kept_record *record,
                           bool *in_parts);
/// What a folder had of a tile of the maps; NULL: nothing, so it is to be made.
const stored_content *passes_kept_stored(const filter_context *context, const kept_record *record,
                                         uint32_t tile);
/// Says that this frame declares all passes that put what is stored into maps that are retained.
/// Once they have run, passes_kept_save frees what was stored.
void passes_kept_place(const filter_context *context, const kept_record *record);
/// Whether that has happened, so that nothing is stored any more.
bool passes_kept_is_placed(const filter_context *context, const kept_record *record);
/// Loads it again: the maps were lost. The subject is that of passes_kept_prepare. Fails the frame
/// on an error.
void passes_kept_reload(const filter_context *context, uint32_t material,
                        const kept_subject *subject, const kept_record *record);
/// Whether nothing is left to do for a tile's file: it is there, or could not be saved.
bool passes_kept_is_settled(const kept_record *record, uint32_t tile);
/// The parts that a tile takes: 0 if the folder had it.
uint32_t passes_kept_tile_parts(const kept_record *record, uint32_t tile);
/// What a folder had of all shares, joined; NULL: nothing, so that it is to be made.
const stored_content *passes_kept_joined(const filter_context *context, const kept_record *record);

/// Whether this frame is to read back a tile, if all that makes it is declared.
bool passes_kept_wants(const filter_context *context, const kept_record *record, uint32_t tile);
/// Reads it back, so that it may be saved. `images`, `buffers`: as in the layout.
void passes_kept_read_back(const filter_context *context, const kept_record *record, uint32_t tile,
                           const lobe_resource *images, const lobe_resource *buffers);
/// Whether all tiles are there, or are made in this frame or before.
bool passes_kept_is_whole(const filter_context *context, const kept_record *record);
/// Of maps of one tile, all of whose passes are declared: reads it back if that is wanted, and
/// returns whether it is whole.
bool passes_kept_built(const filter_context *context, const kept_record *record,
                       const lobe_resource *images, const lobe_resource *buffers);

#endif
