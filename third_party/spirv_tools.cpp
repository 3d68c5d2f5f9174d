#include "third_party/spirv_tools.h"

#include <cstdio>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include <spirv-tools/optimizer.hpp>

#include "third_party/spirv_constants.hpp"
#include "third_party/spirv_dead_blocks.hpp"

namespace {

bool specialise(const spirv_source &source, char *message) {
    spvtools::Optimizer optimiser(SPV_ENV_VULKAN_1_3);
    optimiser.SetMessageConsumer(
        [message](spv_message_level_t, const char *, const spv_position_t &, const char *text) {
            std::snprintf(message, SPIRV_MESSAGE_SIZE, "%s", text);
        });
    std::vector<uint32_t> words;
    spirv_frozen frozen = spirv_freeze_constants(source);
    const std::vector<uint32_t> live = spirv_empty_dead_blocks(std::move(frozen.words));
    // It analyses the whole module, which takes as long as all that follows.
    if (frozen.has_operations)
        optimiser.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    optimiser.RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    if (!optimiser.Run(live.data(), live.size(), &words, options))
        return false;
    source.take(source.user, words.data(), words.size());
    return true;
}

} // namespace

bool third_party_spirv_specialise(const spirv_source *source, char message[SPIRV_MESSAGE_SIZE]) {
    std::snprintf(message, SPIRV_MESSAGE_SIZE, "it is damaged");
    try {
        return specialise(*source, message);
    } catch (const std::bad_alloc &) {
        std::snprintf(message, SPIRV_MESSAGE_SIZE, "out of memory");
    } catch (const std::exception &error) {
        std::snprintf(message, SPIRV_MESSAGE_SIZE, "%s", error.what());
    }
    return false;
}
