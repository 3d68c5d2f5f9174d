#include "third_party/spirv_tools.h"

#include <cstdio>
#include <exception>
#include <new>
#include <unordered_map>
#include <vector>

#include <spirv-tools/optimizer.hpp>

namespace {

using Values = std::unordered_map<uint32_t, std::vector<uint32_t>>;

Values values_of(const spirv_source &source) {
    Values values;
    for (size_t i = 0; i < source.constant_count; i++)
        values[source.constants[i].id] = {source.constants[i].bits};
    return values;
}

bool specialise(const spirv_source &source, char *message) {
    spvtools::Optimizer optimiser(SPV_ENV_VULKAN_1_3);
    optimiser.SetMessageConsumer(
        [message](spv_message_level_t, const char *, const spv_position_t &, const char *text) {
            std::snprintf(message, SPIRV_MESSAGE_SIZE, "%s", text);
        });
    optimiser.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values_of(source)))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<uint32_t> words;
    if (!optimiser.Run(source.words, source.count, &words, options))
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
