#include "third_party/spirv_dead_blocks.hpp"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv_cross/spirv.hpp>

namespace {

constexpr size_t header_length = 5;

/// One instruction, at words[begin].
struct instruction {
    size_t begin, length;
    spv::Op operation;
};

/// From its label to the end of its last instruction.
struct block {
    size_t first, end; ///< indices of instructions
    bool reachable;
    bool kept;         ///< empty, because a branch or a merge instruction names it
    uint32_t loops_to; ///< label of the header whose continue target it is, or 0
};

struct function {
    size_t first, end; ///< indices of instructions
    uint32_t id;
    std::vector<uint32_t> labels; ///< of its blocks, in order
    bool called;
};

class module {
  public:
    explicit module(const std::vector<uint32_t> &source) : words(source) {
    }

    /// False: damaged, or not understood.
    bool parse() {
        if (words.size() < header_length)
            return false;
        for (size_t i = header_length, length; i < words.size(); i += length) {
            length = words[i] >> 16;
            if (length == 0 || length > words.size() - i)
                return false;
            instructions.push_back({i, length, static_cast<spv::Op>(words[i] & 0xffff)});
        }
        for (size_t i = 0; i < instructions.size(); i++)
            if (!add(i))
                return false;
        return !functions.empty() && functions.back().end != 0;
    }

    bool find_reachable() {
        std::vector<uint32_t> waiting = entry_points;
        while (!waiting.empty()) {
            const auto found = numbers_of_functions.find(waiting.back());
            waiting.pop_back();
            if (found == numbers_of_functions.end())
                return false;
            function &next = functions[found->second];
            if (next.called)
                continue;
            next.called = true;
            if (!find_reachable(next, &waiting))
                return false;
        }
        return true;
    }

    std::vector<uint32_t> without_dead() {
        std::vector<uint32_t> result(words.begin(), words.begin() + header_length), bodies;
        const size_t globals = functions.front().first;
        for (const function &next : functions)
            if (next.called)
                add_function(next, &bodies);
            else
                remove(next.first, next.end);
        for (size_t i = 0; i < globals; i++)
            if (!is_about_removed(instructions[i]))
                copy(instructions[i], &result);
        result.insert(result.end(), bodies.begin(), bodies.end());
        return result;
    }

  private:
    uint32_t word(const instruction &next, size_t i) const {
        return words[next.begin + i];
    }

    bool add(size_t index) {
        const instruction &next = instructions[index];
        const bool in_function = !functions.empty() && functions.back().end == 0;
        switch (next.operation) {
        case spv::OpEntryPoint:
            if (next.length < 3)
                return false;
            entry_points.push_back(word(next, 2));
            return true;
        case spv::OpConstantTrue:
        case spv::OpConstantFalse:
            if (next.length != 3)
                return false;
            constants[word(next, 2)] = next.operation == spv::OpConstantTrue;
            return true;
        case spv::OpConstant:
            if (next.length == 4)
                constants[word(next, 2)] = word(next, 3);
            return true;
        case spv::OpFunction:
            if (in_function || next.length != 5)
                return false;
            numbers_of_functions[word(next, 2)] = functions.size();
            functions.push_back({index, 0, word(next, 2), {}, false});
            return true;
        case spv::OpFunctionEnd:
            if (!in_function || !close_block(index))
                return false;
            functions.back().end = index + 1;
            return true;
        case spv::OpLabel:
            if (!in_function || next.length != 2 || !close_block(index))
                return false;
            functions.back().labels.push_back(word(next, 1));
            return blocks.insert({word(next, 1), {index, 0, false, false, 0}}).second;
        default:
            return true;
        }
    }

    bool close_block(size_t end) {
        if (functions.back().labels.empty())
            return true;
        blocks[functions.back().labels.back()].end = end;
        return instructions[end - 1].operation != spv::OpLabel;
    }

    /// The label that a branch on a constant goes to.
    std::optional<uint32_t> chosen(const instruction &branch) const {
        const auto value = constants.find(word(branch, 1));
        if (value == constants.end())
            return std::nullopt;
        if (branch.operation == spv::OpBranchConditional)
            return word(branch, value->second ? 2 : 3);
        for (size_t i = 3; i + 1 < branch.length; i += 2)
            if (word(branch, i) == value->second)
                return word(branch, i + 1);
        return word(branch, 2);
    }

    /// Labels that a block's last instruction names. Nothing: not understood.
    std::optional<std::vector<uint32_t>> targets_of(const instruction &last) const {
        std::vector<uint32_t> targets;
        switch (last.operation) {
        case spv::OpBranch:
            if (last.length != 2)
                return std::nullopt;
            targets.push_back(word(last, 1));
            break;
        case spv::OpBranchConditional:
            if (last.length < 4)
                return std::nullopt;
            targets = {word(last, 2), word(last, 3)};
            break;
        case spv::OpSwitch: // on 32 bits: each case is a number and a label
            if (last.length < 3 || last.length % 2 == 0)
                return std::nullopt;
            for (size_t i = 2; i < last.length; i += 2)
                targets.push_back(word(last, i));
            break;
        case spv::OpReturn:
        case spv::OpReturnValue:
        case spv::OpKill:
        case spv::OpTerminateInvocation:
        case spv::OpUnreachable:
            break;
        default:
            return std::nullopt;
        }
        return targets;
    }

    block *find_block(uint32_t label) {
        const auto found = blocks.find(label);
        return found == blocks.end() ? nullptr : &found->second;
    }

    bool keep(uint32_t label, uint32_t loops_to) {
        block *found = find_block(label);
        if (!found)
            return false;
        found->kept = true;
        if (loops_to)
            found->loops_to = loops_to;
        return true;
    }

    /// What the instructions of a reachable block name, except its branch.
    bool visit_body(const block &found, uint32_t label, std::vector<uint32_t> *callees) {
        bool has_phi = false;
        for (size_t i = found.first; i < found.end; i++) {
            const instruction &next = instructions[i];
            if (next.operation == spv::OpPhi) {
                has_phi = true;
            } else if (next.operation == spv::OpFunctionCall) {
                if (next.length < 4)
                    return false;
                callees->push_back(word(next, 3));
            } else if (next.operation == spv::OpSelectionMerge) {
                if (next.length != 3 || !keep(word(next, 1), 0))
                    return false;
            } else if (next.operation == spv::OpLoopMerge) {
                // A value that comes round an emptied loop would have to be replaced.
                if (has_phi || next.length < 4 || !keep(word(next, 1), 0) ||
                    !keep(word(next, 2), label))
                    return false;
            }
        }
        return true;
    }

    bool find_reachable(const function &body, std::vector<uint32_t> *callees) {
        if (body.labels.empty())
            return false;
        std::vector<uint32_t> waiting = {body.labels.front()};
        while (!waiting.empty()) {
            const uint32_t label = waiting.back();
            waiting.pop_back();
            block *found = find_block(label);
            if (!found)
                return false;
            if (found->reachable)
                continue;
            found->reachable = true;
            const instruction &last = instructions[found->end - 1];
            const auto targets = targets_of(last);
            if (!targets || !visit_body(*found, label, callees))
                return false;
            for (const uint32_t target : *targets)
                if (!keep(target, 0))
                    return false;
            const auto only = targets->size() > 1 ? chosen(last) : std::nullopt;
            if (only)
                waiting.push_back(*only);
            else
                waiting.insert(waiting.end(), targets->begin(), targets->end());
        }
        return true;
    }

    void copy(const instruction &next, std::vector<uint32_t> *result) const {
        result->insert(result->end(), words.begin() + static_cast<std::ptrdiff_t>(next.begin),
                       words.begin() + static_cast<std::ptrdiff_t>(next.begin + next.length));
    }

    /// Without the values that come from unreachable blocks.
    void add_phi(const instruction &next, std::vector<uint32_t> *result) {
        const size_t start = result->size();
        result->insert(result->end(), {0, word(next, 1), word(next, 2)});
        for (size_t i = 3; i + 1 < next.length; i += 2) {
            const block *from = find_block(word(next, i + 1));
            if (!from || from->reachable)
                result->insert(result->end(), {word(next, i), word(next, i + 1)});
        }
        (*result)[start] = static_cast<uint32_t>(result->size() - start) << 16 | spv::OpPhi;
    }

    void add_function(const function &body, std::vector<uint32_t> *result) {
        const size_t blocks_begin = find_block(body.labels.front())->first;
        for (size_t i = body.first; i < blocks_begin; i++)
            copy(instructions[i], result);
        for (const uint32_t label : body.labels) {
            const block &next = *find_block(label);
            if (next.reachable) {
                for (size_t i = next.first; i < next.end; i++)
                    if (instructions[i].operation == spv::OpPhi)
                        add_phi(instructions[i], result);
                    else
                        copy(instructions[i], result);
                continue;
            }
            remove(next.first + next.kept, next.end);
            if (!next.kept)
                continue;
            copy(instructions[next.first], result);
            if (next.loops_to)
                result->insert(result->end(), {2u << 16 | spv::OpBranch, next.loops_to});
            else
                result->push_back(1u << 16 | spv::OpUnreachable);
        }
        copy(instructions[body.end - 1], result);
    }

    /// Notes which identifiers go with these instructions.
    void remove(size_t first, size_t end) {
        for (size_t i = first; i < end; i++) {
            bool has_result = false, has_type = false;
            spv::HasResultAndType(instructions[i].operation, &has_result, &has_type);
            const size_t at = 1 + has_type;
            if (has_result && at < instructions[i].length)
                removed.insert(word(instructions[i], at));
        }
    }

    bool is_about_removed(const instruction &next) const {
        return (next.operation == spv::OpName || next.operation == spv::OpDecorate) &&
               next.length > 1 && removed.count(word(next, 1));
    }

    const std::vector<uint32_t> &words;
    std::vector<instruction> instructions;
    std::vector<function> functions;
    std::vector<uint32_t> entry_points;
    std::unordered_map<uint32_t, uint32_t> constants; ///< of at most 32 bits
    std::unordered_map<uint32_t, size_t> numbers_of_functions;
    std::unordered_map<uint32_t, block> blocks; ///< by label
    std::unordered_set<uint32_t> removed;
};

} // namespace

std::vector<uint32_t> spirv_empty_dead_blocks(std::vector<uint32_t> words) {
    module whole(words);
    return whole.parse() && whole.find_reachable() ? whole.without_dead() : std::move(words);
}
