#ifndef THIRD_PARTY_SPIRV_DEAD_BLOCKS_HPP
#define THIRD_PARTY_SPIRV_DEAD_BLOCKS_HPP

#include <cstdint>
#include <vector>

/// Empties the blocks of a valid module that constant conditions make unreachable, and removes the
/// functions that nothing calls any more. Branches stay as they are, so that the module remains
/// valid: simplifying them is left to SPIRV-Tools, whose time goes by the size of what it is given,
/// of which most is unreachable. A module that is damaged, or that this does not understand, comes
/// back unchanged. Throws std::bad_alloc.
std::vector<uint32_t> spirv_empty_dead_blocks(std::vector<uint32_t> words);

#endif
