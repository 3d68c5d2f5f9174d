#ifndef PASSES_FILTERS_LOBES_CLUSTERING_H
#define PASSES_FILTERS_LOBES_CLUSTERING_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// A map of lobe mixtures. Its layers are described in shaders/interface/mixture.h.
typedef struct mixture_map {
    reduced_map map;
    lobe_format format;
    uint32_t subdivision; ///< [0, 2]: 1, 4 or 8 clusters at the finest
    uint32_t mean_layer;  ///< layer of the mean normal and length; 0: none
    lobe_map_space space; ///< tangent, object or camera
    bool weighted;        ///< texels count by what they mirror
    uint32_t kept_layer;  ///< layer of the coverage, where the weights are not that; 0: none
    uint32_t width_layer; ///< the first of those of the widths of base lobes; 0: none
    bool width_colours;   ///< the last of these is of their colours
} mixture_map;

/// What is wanted of a mixture map.
typedef struct mixture_request {
    lobe_map_space space;
    uint32_t subdivision; ///< [0, 2]
    uint32_t clusters;    ///< CLUSTERS_... of shaders/interface/cluster.h
    bool mean;            ///< also the layer of the mean
    bool widths;          ///< also those of widths
    bool width_colours;   ///< also that of their colours; for mixtures that are weighted
} mixture_request;

/// Declares a mixture map for an instance's material and adds the passes that fill level 0:
/// characteristic vectors (Xu et al. 2017, Eqs. 8-14) and clustering by direction (section 3.2).
/// The request says which layers shading will read. The material has a normal or width
/// map.
mixture_map passes_lobe_clustering(const filter_context *context, size_t instance,
                                   const mixture_request *request);

#endif
