#include "third_party/spirv_inlining.h"

#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <spirv_cross/spirv.hpp>

namespace {

constexpr size_t header_length = 5;

spvtools::MessageConsumer errors_to(char *message) {
    return [message](spv_message_level_t level, const char *, const spv_position_t &,
                     const char *text) {
        if (level <= SPV_MSG_ERROR)
            std::snprintf(message, SPIRV_INLINING_MESSAGE_SIZE, "%s", text);
    };
}

bool run(spvtools::Optimizer &optimiser, std::vector<uint32_t> &words) {
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    options.set_preserve_bindings(true);
    options.set_preserve_spec_constants(true);
    return optimiser.Run(words.data(), words.size(), &words, options);
}

/// Calls `visit(operation, place)` for each instruction.
template <typename visitor> void for_each_instruction(std::vector<uint32_t> &words, visitor visit) {
    for (size_t place = header_length; place < words.size(); place += words[place] >> 16)
        visit(static_cast<spv::Op>(words[place] & 0xffff), place);
}

/// Marks the functions that cannot be inlined: those that return before their last block. The
/// optimiser leaves them alone in any case, but at each call writes the whole module as text to
/// warn of it, which took most of the time of a shading shader. Marked, they draw no warning.
void mark_early_returns(std::vector<uint32_t> &words) {
    size_t control = 0;
    bool returned = false, early = false;
    for_each_instruction(words, [&](spv::Op operation, size_t place) {
        if (operation == spv::OpFunction) {
            control = place + 3;
            returned = early = false;
        } else if (operation == spv::OpReturn || operation == spv::OpReturnValue) {
            returned = true;
        } else if (operation == spv::OpLabel) {
            early = early || returned;
        } else if (operation == spv::OpFunctionEnd && early) {
            words[control] |= spv::FunctionControlDontInlineMask;
        }
    });
}

/// Drivers decide for themselves what they inline.
void clear_marks(std::vector<uint32_t> &words) {
    for_each_instruction(words, [&](spv::Op operation, size_t place) {
        if (operation == spv::OpFunction)
            words[place + 3] &= ~static_cast<uint32_t>(spv::FunctionControlDontInlineMask);
    });
}

/// Drivers inline all functions anyway. Where they need not do it, and meet no variables that
/// merely pass arguments, lavapipe creates a shading pipeline in half the time. Branches that a
/// variant does not take go before that: they would be inlined at every call.
bool inline_functions(std::vector<uint32_t> &words, char *message) {
    spvtools::Optimizer before(SPV_ENV_VULKAN_1_3), inlining(SPV_ENV_VULKAN_1_3);
    before.SetMessageConsumer(errors_to(message));
    before.RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    inlining.SetMessageConsumer(errors_to(message));
    inlining.RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    if (!run(before, words))
        return false;
    mark_early_returns(words);
    if (!run(inlining, words))
        return false;
    clear_marks(words);
    return true;
}

/// The compiler sometimes generates invalid SPIR-V for constants computed from specialisation
/// constants, and the optimiser keeps these: this sees what a driver will see. It takes ten times
/// as long before functions are inlined.
bool validate(const std::vector<uint32_t> &words, char *message) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    tools.SetMessageConsumer(errors_to(message));
    spvtools::ValidatorOptions options;
    // Finding names takes most of the time, and they are needed only where something is wrong.
    options.SetFriendlyNames(false);
    if (tools.Validate(words.data(), words.size(), options))
        return true;
    options.SetFriendlyNames(true);
    return tools.Validate(words.data(), words.size(), options);
}

} // namespace

bool third_party_spirv_inline(const uint32_t *words, size_t count,
                              void (*take)(void *user, const uint32_t *words, size_t count),
                              void *user, char message[SPIRV_INLINING_MESSAGE_SIZE]) {
    std::snprintf(message, SPIRV_INLINING_MESSAGE_SIZE, "it is damaged");
    try {
        std::vector<uint32_t> inlined(words, words + count);
        if (!inline_functions(inlined, message) || !validate(inlined, message))
            return false;
        take(user, inlined.data(), inlined.size());
        return true;
    } catch (const std::bad_alloc &) {
        std::snprintf(message, SPIRV_INLINING_MESSAGE_SIZE, "out of memory");
    } catch (const std::exception &error) {
        std::snprintf(message, SPIRV_INLINING_MESSAGE_SIZE, "%s", error.what());
    }
    return false;
}
