// The drawn envelope (M14a), as src/strands/drawn_envelope.h: a place on a wisp is a piece and a share t of it, and a point of the
// unit disc, (x, y) = α d_k + β d_{k+1}, stands for the centre + α a_k + β a_{k+1}.
#include "catmull_rom.glsl"

const int kMostHalfLines = 16;
uniform highp sampler2D uSections; // per section K + 1 records: the centre, the ends of the half lines relative to it
uniform int uHalfLines;            // K
uniform vec2 uHalfLine[kMostHalfLines + 1]; // their directions in the disc, the first again at the end

struct Piece {
    ivec4 sections; // its four control points
    vec4 weight, slope;
};

// Piece `piece` of the wisp with the sections first … first + last, at t.
Piece pieceAt(int first, int last, int piece, float t) {
    ivec4 i = ivec4(max(piece - 1, 0), piece, piece + 1, min(piece + 2, last));
    return Piece(first + i, catmullRom(t), catmullRomSlope(t));
}

vec3 sectionRecord(int section, int i) {
    int at = section * (uHalfLines + 1) + i;
    return texelFetch(uSections, ivec2(at & 1023, at >> 10), 0).xyz;
}

mat4x3 sectionRecords(Piece p, int i) {
    return mat4x3(sectionRecord(p.sections.x, i), sectionRecord(p.sections.y, i),
                  sectionRecord(p.sections.z, i), sectionRecord(p.sections.w, i));
}

float cross2(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

struct EnvelopePoint {
    vec3 position;
    vec3 along;  // its change with t, the disc's point moving with `discSlope`
    mat2x3 across; // its change with the disc's x and y
};

EnvelopePoint envelopePoint(Piece p, vec2 disc, vec2 discSlope) {
    int k = 0; // the last half line that is not ahead of the point, going round
    for (; k + 1 < uHalfLines; ++k)
        if (cross2(uHalfLine[k], disc) >= 0.0 && cross2(disc, uHalfLine[k + 1]) > 0.0) break;
    vec2 a = uHalfLine[k], b = uHalfLine[k + 1];
    float area = cross2(a, b);
    mat4x3 centre = sectionRecords(p, 0);
    mat4x3 first = sectionRecords(p, 1 + k);
    mat4x3 second = sectionRecords(p, 1 + (k + 1 < uHalfLines ? k + 1 : 0));
    vec3 ak = first * p.weight, bk = second * p.weight;
    vec2 toFirst = vec2(b.y, -b.x) / area, toSecond = vec2(-a.y, a.x) / area;
    float alpha = dot(toFirst, disc), beta = dot(toSecond, disc);
    EnvelopePoint e;
    e.position = centre * p.weight + ak * alpha + bk * beta;
    e.across = mat2x3(ak * toFirst.x + bk * toSecond.x, ak * toFirst.y + bk * toSecond.y);
    e.along = centre * p.slope + first * p.slope * alpha + second * p.slope * beta + e.across * discSlope;
    return e;
}
