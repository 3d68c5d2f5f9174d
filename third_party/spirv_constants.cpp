#include "third_party/spirv_constants.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include <spirv_cross/spirv.hpp>

namespace {

constexpr size_t header_length = 5;

/// One instruction of a module.
struct instruction {
    const uint32_t *words;
    size_t length;

    spv::Op operation() const {
        return static_cast<spv::Op>(words[0] & 0xffff);
    }
};

uint32_t first_word(spv::Op operation, uint32_t length) {
    return length << 16 | operation;
}

std::optional<uint32_t> result_of(spv::Op operation, uint32_t a, uint32_t b) {
    switch (operation) {
    case spv::OpLogicalNot:
        return !a;
    case spv::OpLogicalAnd:
        return a && b;
    case spv::OpLogicalOr:
        return a || b;
    case spv::OpIEqual:
        return a == b;
    case spv::OpINotEqual:
        return a != b;
    case spv::OpUGreaterThan:
        return a > b;
    case spv::OpUGreaterThanEqual:
        return a >= b;
    case spv::OpULessThan:
        return a < b;
    case spv::OpULessThanEqual:
        return a <= b;
    case spv::OpBitwiseAnd:
        return a & b;
    case spv::OpBitwiseOr:
        return a | b;
    case spv::OpIAdd:
        return a + b;
    case spv::OpISub:
        return a - b;
    case spv::OpIMul:
        return a * b;
    case spv::OpUDiv:
        return b ? std::optional(a / b) : std::nullopt;
    default:
        return std::nullopt;
    }
}

class freezer {
  public:
    explicit freezer(const spirv_source &source) {
        for (size_t i = 0; i < source.constant_count; i++)
            given[source.constants[i].id] = source.constants[i].bits;
        words.assign(source.words, source.words + std::min(source.count, header_length));
        words.reserve(source.count);
    }

    void add(const instruction &next) {
        switch (next.operation()) {
        case spv::OpDecorate:
            return add_decoration(next);
        case spv::OpTypeBool:
            booleans.insert(next.length > 1 ? next.words[1] : 0);
            break;
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
            if (next.length > 2 && next.words[2] == 32)
                numbers.insert(next.words[1]);
            break;
        case spv::OpConstantTrue:
        case spv::OpConstantFalse:
        case spv::OpConstant:
        case spv::OpSpecConstantTrue:
        case spv::OpSpecConstantFalse:
        case spv::OpSpecConstant:
            if (next.length > 2)
                return add_constant(next);
            break;
        case spv::OpSpecConstantOp:
            return add_operation(next);
        default:
            break;
        }
        copy(next);
    }

    void copy(const instruction &next) {
        words.insert(words.end(), next.words, next.words + next.length);
    }

    spirv_frozen take() {
        return {std::move(words), has_operations};
    }

  private:
    void add_decoration(const instruction &next) {
        if (next.length == 4 && next.words[2] == spv::DecorationSpecId)
            numbers_of_ids[next.words[1]] = next.words[3];
        else
            copy(next);
    }

    void add_value(uint32_t type, uint32_t id, uint32_t value) {
        values[id] = value;
        if (booleans.count(type)) {
            const spv::Op operation = value ? spv::OpConstantTrue : spv::OpConstantFalse;
            words.insert(words.end(), {first_word(operation, 3), type, id});
        } else {
            words.insert(words.end(), {first_word(spv::OpConstant, 4), type, id, value});
        }
    }

    /// Constants of more bits keep their defaults.
    void add_constant(const instruction &next) {
        const uint32_t type = next.words[1], id = next.words[2];
        const spv::Op operation = next.operation();
        const auto number = numbers_of_ids.find(id);
        const auto value =
            number == numbers_of_ids.end() ? given.end() : given.find(number->second);
        if (next.length == 3) {
            const bool initial =
                operation == spv::OpSpecConstantTrue || operation == spv::OpConstantTrue;
            add_value(type, id, value == given.end() ? initial : value->second != 0);
        } else if (next.length == 4 && numbers.count(type)) {
            add_value(type, id, value == given.end() ? next.words[3] : value->second);
        } else {
            copy(next);
            words[words.size() - next.length] =
                first_word(spv::OpConstant, static_cast<uint32_t>(next.length));
            if (value != given.end() && next.length == 4)
                words.back() = value->second;
        }
    }

    std::optional<uint32_t> value_of(uint32_t id) const {
        const auto found = values.find(id);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    }

    std::optional<uint32_t> compute(const instruction &next) const {
        if (next.length < 5 || (!booleans.count(next.words[1]) && !numbers.count(next.words[1])))
            return std::nullopt;
        const auto operation = static_cast<spv::Op>(next.words[3]);
        const std::optional<uint32_t> a = value_of(next.words[4]);
        if (!a)
            return std::nullopt;
        if (operation == spv::OpSelect && next.length == 7)
            return value_of(next.words[*a ? 5 : 6]);
        if (next.length == 5)
            return operation == spv::OpLogicalNot ? result_of(operation, *a, 0) : std::nullopt;
        const std::optional<uint32_t> b = value_of(next.words[5]);
        return b && next.length == 6 ? result_of(operation, *a, *b) : std::nullopt;
    }

    void add_operation(const instruction &next) {
        const std::optional<uint32_t> value = compute(next);
        if (value)
            return add_value(next.words[1], next.words[2], *value);
        has_operations = true;
        copy(next);
    }

    std::unordered_map<uint32_t, uint32_t> given;          // by number of specialisation
    std::unordered_map<uint32_t, uint32_t> numbers_of_ids; // of specialisation
    std::unordered_map<uint32_t, uint32_t> values;         // of constants of at most 32 bits, by id
    std::unordered_set<uint32_t> booleans, numbers;        // types; numbers of 32 bits
    std::vector<uint32_t> words;
    bool has_operations = false;
};

} // namespace

spirv_frozen spirv_freeze_constants(const spirv_source &source) {
    freezer frozen(source);
    size_t length = 0;
    for (size_t i = header_length; i < source.count; i += length) {
        length = source.words[i] >> 16;
        const bool damaged = length == 0 || length > source.count - i; // the optimiser refuses it
        if (damaged)
            length = source.count - i;
        const instruction next = {source.words + i, length};
        damaged ? frozen.copy(next) : frozen.add(next);
    }
    return frozen.take();
}
