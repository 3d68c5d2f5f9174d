"""Marks the functions of a SPIR-V module that spirv-opt cannot inline: those that return before
their last block. It leaves them alone in any case, but at each call writes the whole module as text
to warn of it, which took most of the time of a shading shader. Marked, they draw no warning."""

import array

# SPIR-V: words of a module's header, operations, and a bit of what OpFunction says of itself.
HEADER_WORDS = 5
OP_FUNCTION, OP_FUNCTION_END, OP_LABEL, OP_RETURN, OP_RETURN_VALUE = 54, 56, 248, 253, 254
DONT_INLINE = 2


def instructions(words):
    """The place and the operation of each instruction of a module."""
    place = HEADER_WORDS
    while place < len(words):
        yield place, words[place] & 0xffff
        place += words[place] >> 16


def mark(path):
    """Marks them in the module in a file."""
    words = array.array("I", path.read_bytes())
    control = returned = early = None
    for place, operation in instructions(words):
        if operation == OP_FUNCTION:
            control, returned, early = place + 3, False, False
        elif operation in (OP_RETURN, OP_RETURN_VALUE):
            returned = True
        elif operation == OP_LABEL:
            early = early or returned
        elif operation == OP_FUNCTION_END and early:
            words[control] |= DONT_INLINE
    path.write_bytes(words.tobytes())


def clear(path):
    """Removes the marks: drivers decide for themselves what they inline."""
    words = array.array("I", path.read_bytes())
    for place, operation in instructions(words):
        if operation == OP_FUNCTION:
            words[place + 3] &= ~DONT_INLINE
    path.write_bytes(words.tobytes())
