#include "third_party/spirv_tools.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <unordered_map>
#include <vector>

#include <spirv-tools/optimizer.hpp>
#include <spirv_cross/spirv.hpp>

namespace {

using Values = std::unordered_map<uint32_t, uint32_t>;

Values values_of(const spirv_source &source) {
    Values values;
    for (size_t i = 0; i < source.constant_count; i++)
        values[source.constants[i].id] = source.constants[i].bits;
    return values;
}

bool is_specialisation(const uint32_t *instruction, size_t length) {
    return (instruction[0] & 0xffff) == spv::OpDecorate && length == 4 &&
           instruction[2] == spv::DecorationSpecId;
}

/// Turns a specialisation constant of at most 32 bits into an ordinary one. `bits`: NULL: its
/// default.
void freeze_constant(uint32_t *instruction, size_t length, const uint32_t *bits) {
    const uint32_t operation = instruction[0] & 0xffff, size = instruction[0] & 0xffff0000;
    if (operation == spv::OpSpecConstantTrue || operation == spv::OpSpecConstantFalse) {
        const bool value = bits ? *bits != 0 : operation == spv::OpSpecConstantTrue;
        instruction[0] = size | (value ? spv::OpConstantTrue : spv::OpConstantFalse);
    } else if (operation == spv::OpSpecConstant) {
        instruction[0] = size | spv::OpConstant;
        if (bits && length == 4)
            instruction[3] = *bits;
    }
}

/// The module with its specialisation constants set. The optimiser has passes for this, which
/// analyse the whole module twice and take about as long as all that follows.
std::vector<uint32_t> freeze(const spirv_source &source) {
    const size_t header = 5;
    const Values values = values_of(source);
    Values ids; // of specialisation, by result
    std::vector<uint32_t> words(source.words, source.words + std::min(source.count, header));
    words.reserve(source.count);
    size_t length = 0;
    for (size_t i = header; i < source.count; i += length) {
        const uint32_t *instruction = source.words + i;
        length = instruction[0] >> 16;
        if (length == 0 || length > source.count - i)
            length = source.count - i; // damaged, which the optimiser refuses
        if (is_specialisation(instruction, length)) {
            ids[instruction[1]] = instruction[3];
            continue;
        }
        words.insert(words.end(), instruction, instruction + length);
        if (length < 3)
            continue;
        const auto id = ids.find(instruction[2]);
        const auto value = id == ids.end() ? values.end() : values.find(id->second);
        freeze_constant(&words[words.size() - length], length,
                        value == values.end() ? nullptr : &value->second);
    }
    return words;
}

bool specialise(const spirv_source &source, char *message) {
    spvtools::Optimizer optimiser(SPV_ENV_VULKAN_1_3);
    optimiser.SetMessageConsumer(
        [message](spv_message_level_t, const char *, const spv_position_t &, const char *text) {
            std::snprintf(message, SPIRV_MESSAGE_SIZE, "%s", text);
        });
    optimiser.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<uint32_t> words;
    const std::vector<uint32_t> frozen = freeze(source);
    if (!optimiser.Run(frozen.data(), frozen.size(), &words, options))
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
