#ifndef THIRD_PARTY_SPIRV_CONSTANTS_HPP
#define THIRD_PARTY_SPIRV_CONSTANTS_HPP

#include <cstdint>
#include <vector>

#include "third_party/spirv_tools.h"

struct spirv_frozen {
    std::vector<uint32_t> words;
    bool has_operations; ///< on constants, which SPIRV-Tools must compute
};

/// The module with its specialisation constants set, and what it computes from them computed: the
/// operations on booleans and 32-bit integers that our shaders use. The optimiser has passes for
/// this, each of which analyses the whole module and takes about as long as all that follows.
/// Throws std::bad_alloc.
spirv_frozen spirv_freeze_constants(const spirv_source &source);

#endif
