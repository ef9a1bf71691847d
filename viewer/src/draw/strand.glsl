// Any point of any strand, from the cross-sections of the frame and the strand's recipe: what src/strands makes in C++.
#include "envelope.glsl"

uniform highp usampler2D uShares; // per strand and piece: jitter's numbers of its four control points, in 1/65535
uniform highp sampler2D uWaves;   // per section two records, see strand_waves.ts
uniform float uJitter;
uniform float uWaveAmplitude;
uniform bool uWavesOrCurls;

struct Strand {
    int first, last;  // sections of its wisp: the first, and how many more
    int firstShare;   // its first record in uShares
    vec2 place;       // in the disc
    float end;        // p where it ends
    float phase;      // [rad] its own part of the waves' phase
};

struct StrandPoint {
    vec3 position; // [m] relative to the frame's origin
    vec3 along;    // toward the tip, per p
};

// A sine of our own: a graphics processor's may be off by 2⁻¹¹, a tenth of a millimetre on a wisp.
float sine(float x) {
    float turns = floor(x * 0.15915494 + 0.5);
    x = (x - turns * 6.28125) - turns * 0.0019353072;
    x = abs(x) > 1.5707963 ? sign(x) * 3.1415927 - x : x;
    float y = x * x;
    return x + x * y * (-1.6666667e-1 + y * (8.3333333e-3 + y * (-1.9841270e-4 + y * (2.7557319e-6 - y * 2.5052108e-8))));
}
vec2 unitVector(float angle) {
    return vec2(sine(angle + 1.5707963), sine(angle));
}

vec4 waveRecord(int section, int i) {
    int at = section * 2 + i;
    return texelFetch(uWaves, ivec2(at & 1023, at >> 10), 0);
}

// Curls (M19) turn the disc's point, waves (M18) move it.
void curlAndWave(int section, float t, float ownPhase, inout vec2 disc, inout vec2 slope) {
    vec4 r = waveRecord(section, 0), q = waveRecord(section, 1);
    vec2 turn = unitVector(q.z + q.w * t);
    disc = vec2(disc.x * turn.x - disc.y * turn.y, disc.x * turn.y + disc.y * turn.x);
    slope = vec2(slope.x * turn.x - slope.y * turn.y, slope.x * turn.y + slope.y * turn.x);
    slope += q.w * vec2(-disc.y, disc.x);
    float left = t < 0.5 ? mix(r.z, r.w, 2.0 * t) : mix(r.w, q.x, 2.0 * t - 1.0);
    vec2 direction = unitVector(q.y) * (uWaveAmplitude * left);
    float phase = r.x + r.y * t + ownPhase;
    disc += direction * sine(phase);
    slope += direction * (r.y * sine(phase + 1.5707963));
}

StrandPoint strandPoint(Strand s, float p) {
    int piece = min(int(p), s.last - 1);
    float t = p - float(piece);
    Piece at = pieceAt(s.first, s.last, piece, t);
    int record = s.firstShare + piece;
    vec4 share = 1.0 - uJitter / 65535.0 * vec4(texelFetch(uShares, ivec2(record & 2047, record >> 11), 0));
    vec2 disc = s.place * dot(share, at.weight), slope = s.place * dot(share, at.slope);
    if (uWavesOrCurls) curlAndWave(s.first + piece, t, s.phase, disc, slope);
    EnvelopePoint e = envelopePoint(at, disc, slope);
    return StrandPoint(e.position, e.along);
}

// Where vertex i of n is along its strand: the first at x₀, inside the head, the others from x₁ on.
float vertexParameter(Strand s, int i, int n) {
    return i == 0 ? 0.0 : 1.0 + (s.end - 1.0) * (float(i - 1) / float(n - 2));
}
