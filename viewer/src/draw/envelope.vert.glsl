#version 300 es
// The envelopes' surface: a vertex at a place on its wisp and a point of the disc's rim, or of its inside where it is closed.
precision highp float;
precision highp int;
#include "envelope.glsl"
#include "wisp_colour.glsl"
layout(location = 0) in ivec4 aPlace; // first section of the wisp, how many more, piece, wisp
layout(location = 1) in vec3 aOnPiece; // t, disc x, y
uniform mat4 uClip;
uniform int uSelected;
out vec3 vPosition;
out vec3 vNormal;
flat out vec3 vColour;
void main() {
    vec2 disc = aOnPiece.yz;
    EnvelopePoint e = envelopePoint(pieceAt(aPlace.x, aPlace.y, aPlace.z, aOnPiece.x), disc, vec2(0.0));
    vec3 round = e.across * vec2(-disc.y, disc.x);
    vPosition = e.position;
    vNormal = disc == vec2(0.0) ? e.along : cross(round, e.along);
    vColour = wispColour(aPlace.w);
    if (uSelected >= 0 && aPlace.w != uSelected) vColour = mix(vec3(dot(vColour, vec3(0.33))), vColour, 0.25) * 0.6;
    gl_Position = uClip * vec4(vPosition, 1.0);
}
