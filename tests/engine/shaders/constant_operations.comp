#version 460

// What is computed from specialisation constants, to test that it is computed once.

layout(constant_id = 0) const uint a = 1;
layout(constant_id = 1) const uint b = 1;
layout(constant_id = 2) const bool c = false;

const uint sum = a + b;
const uint difference = a - b;
const uint product = a * b;
const uint quotient = a / b;
const uint shared_bits = a & b;
const uint larger = a > b ? 1001 : 2001;
const uint not_smaller = a >= b ? 1002 : 2002;
const uint smaller = a < b ? 1003 : 2003;
const uint not_larger = a <= b ? 1004 : 2004;
const uint equal = a == b ? 1005 : 2005;
const uint different = a != b ? 1006 : 2006;
const uint both = a == b && c ? 1007 : 2007;
const uint either = a == b || c ? 1008 : 2008;
const uint neither = !c ? 1009 : 2009;

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) writeonly buffer Results {
    uint results[];
};

void main() {
    results[0] = sum;
    results[1] = difference;
    results[2] = product;
    results[3] = quotient;
    results[4] = shared_bits;
    results[5] = larger;
    results[6] = not_smaller;
    results[7] = smaller;
    results[8] = not_larger;
    results[9] = equal;
    results[10] = different;
    results[11] = both;
    results[12] = either;
    results[13] = neither;
}
