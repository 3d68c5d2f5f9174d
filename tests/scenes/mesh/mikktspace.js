// Makes mikktspace.txt: meshes, and their tangents by the npm package mikktspace 1.1.1, which is
// Morten Mikkelsen's own code in WebAssembly.
//
//     npm install mikktspace@1.1.1 && node mikktspace.js > mikktspace.txt
//
// A line of the output is `mesh NAME VERTICES CORNERS`, a vertex (position, normal, coordinates) or
// a corner (vertex, tangent, w). The package's w is for v upwards; glTF's is the opposite. Corners
// without a tangent have w = 0: those in triangles with two corners at one place, and those where
// the package answers with its default or with rounding, which do not turn with the mesh.

const { generateTangents } = require('mikktspace');

const length = v => Math.hypot(...v);
const unit = v => v.map(x => x / length(v));
const rounded = x => +x.toFixed(5);

// A row of vertices for each v, a column for each u; both from 0 to 1.
function grid(rows, columns, place) {
    const mesh = { vertices: [], indices: [] };
    for (let r = 0; r <= rows; r++)
        for (let c = 0; c <= columns; c++)
            mesh.vertices.push(place(c / columns, r / rows));
    for (let r = 0; r < rows; r++)
        for (let c = 0; c < columns; c++) {
            const a = r * (columns + 1) + c, b = a + columns + 1;
            mesh.indices.push(a, b, a + 1, a + 1, b, b + 1);
        }
    return mesh;
}

function wave(u, v, s, t) {
    const x = 2 * u - 1, y = 2 * v - 1;
    const dx = 0.9 * Math.cos(3 * x) * Math.cos(2 * y);
    const dy = -0.6 * Math.sin(3 * x) * Math.sin(2 * y);
    return [x, 0.3 * Math.sin(3 * x) * Math.cos(2 * y), y, ...unit([-dx, 1, -dy]), s, t];
}

function sphere(coordinates) {
    return grid(5, 8, (u, v) => {
        const angle = 2 * Math.PI * (u % 1), pole = v === 0 || v === 1;
        const radius = pole ? 0 : Math.sin(Math.PI * v);
        const n = [radius * Math.cos(angle), Math.cos(Math.PI * v), -radius * Math.sin(angle)];
        return [...n, ...n, ...coordinates(u, v)];
    });
}

function cube(smooth) {
    const mesh = { vertices: [], indices: [] };
    for (let axis = 0; axis < 3; axis++)
        for (const side of [1, -1]) {
            const first = mesh.vertices.length;
            for (let k = 0; k < 4; k++) {
                const p = [0, 0, 0], n = [0, 0, 0], u = k & 1, v = k >> 1;
                p[axis] = n[axis] = side;
                p[(axis + 1) % 3] = 2 * u - 1;
                p[(axis + 2) % 3] = 2 * v - 1;
                mesh.vertices.push([...p, ...(smooth ? unit(p) : n), u + 0.2 * v, v]);
            }
            const front = [0, 1, 3, 0, 3, 2], back = [0, 3, 1, 0, 2, 3];
            mesh.indices.push(...(side > 0 ? front : back).map(k => first + k));
        }
    return mesh;
}

function unwelded(mesh) {
    return {
        vertices: mesh.indices.map(i => mesh.vertices[i]),
        indices: mesh.indices.map((_, k) => k)
    };
}

// Triangles with two corners at one place: of repeated indices, and of repeated positions.
function collapsed() {
    const mesh = grid(3, 3, (u, v) => wave(u, v, u, v));
    mesh.vertices.push(mesh.vertices[3]);
    mesh.indices.unshift(3, mesh.vertices.length - 1, 10, 5, 5, 9);
    return mesh;
}

// Two fans that share one vertex.
function fans() {
    const mesh = { vertices: [[0, 0, 0, 0, 1, 0, 0.5, 0.5]], indices: [] };
    for (let fan = 0; fan < 2; fan++)
        for (let k = 0; k < 4; k++) {
            const angle = 0.5 * k + Math.PI * fan, turn = 0.7 * k + 1.9 * fan;
            const next = 4 * fan + k + 1;
            mesh.vertices.push([Math.cos(angle), 0.2 * fan, -Math.sin(angle), 0, 1, 0,
                0.5 + 0.4 * Math.cos(turn), 0.5 - 0.4 * Math.sin(turn)]);
            if (k < 3)
                mesh.indices.push(0, next, next + 1);
        }
    return mesh;
}

// A triangle whose corners lie on one line, between its neighbours.
function flat() {
    return {
        vertices: [[0, 0, 0, 0, 1, 0, 0, 0], [2, 0, 0, 0, 1, 0, 1, 0], [1, 0, 0, 0, 1, 0, 0.5, 0.1],
            [0, 0, -2, 0, 1, 0, 0, 1], [1, 0, 2, 0, 1, 0, 0.4, -1]],
        indices: [0, 1, 3, 0, 2, 1, 0, 4, 2, 2, 4, 1]
    };
}

// Five triangles at one edge.
function book() {
    const mesh = { vertices: [[0, 0, 0, 0, 1, 0, 0, 0], [0, 0, 1, 0, 1, 0, 0, 1]], indices: [] };
    for (let k = 0; k < 5; k++) {
        const angle = 1.2 * k;
        mesh.vertices.push([Math.cos(angle), 0.5 * Math.sin(angle), 0.3, 0, 1, 0,
            Math.cos(1.3 * angle), 0.2 + 0.1 * k]);
        mesh.indices.push(...(k % 2 ? [0, 1] : [1, 0]), k + 2);
    }
    return mesh;
}

// Knuth 1981, "The art of computer programming 2", section 3.3.4: a linear congruential generator.
let state = 1;
function random(n) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor(state / 2 ** 32 * n);
}

function jumble() {
    const mesh = { vertices: [], indices: [] };
    for (let k = 0; k < 16; k++) {
        const p = [random(100), random(100), random(100)].map(x => x / 99);
        mesh.vertices.push([...p, ...unit([p[0] - 0.45, p[1] - 0.37, p[2] - 0.61]),
            random(100) / 99, random(100) / 99]);
    }
    for (let k = 0; k < 75; k++)
        mesh.indices.push(random(16));
    return mesh;
}

const inwards = v => [...v.slice(0, 3), ...v.slice(3, 6).map(x => -x), ...v.slice(6)];
const meshes = {
    'hard cube': cube(false),
    'smooth cube': cube(true),
    'sphere with a seam': sphere((u, v) => [u, v]),
    'mirrored sphere': sphere((u, v) => [Math.abs(2 * u - 1), v]),
    'mirrored twice': grid(4, 4, (u, v) => wave(u, v, Math.abs(u - 0.5), Math.abs(v - 0.5))),
    'no area in half of the coordinates': grid(4, 4, (u, v) => wave(u, v, Math.max(u, 0.5), v)),
    'one point of the coordinates': grid(4, 4, (u, v) => u < 0.4 ? wave(u, v, 0.3, 0.5)
        : wave(u, v, u, v)),
    'one line of the coordinates': grid(2, 2, (u, v) => wave(u, v, 0.5, v)),
    'scattered coordinates': grid(5, 5, (u, v) => wave(u, v, random(3) / 2, random(3) / 2)),
    'normals inwards': grid(3, 3, (u, v) => inwards(wave(u, v, u, v))),
    'unwelded': unwelded(grid(3, 3, (u, v) => wave(u, v, u, v))),
    'collapsed triangles': collapsed(),
    'two fans': fans(),
    'a flat triangle': flat(),
    'five triangles at an edge': book(),
    'jumble': jumble(),
};

// An arbitrary rotation, from the quaternion (1, 2, 3, 4) / sqrt(30).
const rows = [[-20, 4, 22], [20, -10, 20], [10, 28, 4]];
const turned = v => rows.map(r => (r[0] * v[0] + r[1] * v[1] + r[2] * v[2]) / 30);
const same = v => v;

function tangents(mesh, rotate) {
    const gather = part => Float32Array.from(mesh.indices.flatMap(i => part(mesh.vertices[i])));
    const all = generateTangents(gather(v => rotate(v.slice(0, 3))),
        gather(v => rotate(v.slice(3, 6))), gather(v => v.slice(6)));
    return mesh.indices.map((_, k) => [...all.slice(4 * k, 4 * k + 4)]);
}

function isCollapsed(mesh, corner) {
    const first = corner - corner % 3;
    const p = [0, 1, 2].map(k => mesh.vertices[mesh.indices[first + k]].slice(0, 3).join());
    return p[0] === p[1] || p[1] === p[2] || p[2] === p[0];
}

for (const [name, mesh] of Object.entries(meshes)) {
    mesh.vertices = mesh.vertices.map(v => v.map(rounded));
    console.log(`mesh ${name.replaceAll(' ', '_')} ${mesh.vertices.length} ${mesh.indices.length}`);
    for (const v of mesh.vertices)
        console.log(v.join(' '));
    const found = tangents(mesh, same), afterTurning = tangents(mesh, turned);
    mesh.indices.forEach((vertex, k) => {
        const t = found[k], length3 = length(t.slice(0, 3));
        const moved = length(turned(t).map((x, i) => x - afterTurning[k][i]));
        const none = isCollapsed(mesh, k) || Math.abs(length3 - 1) > 1e-3 || moved > 3e-4;
        console.log([vertex, ...t.slice(0, 3).map(rounded), none ? 0 : -t[3]].join(' '));
    });
}
