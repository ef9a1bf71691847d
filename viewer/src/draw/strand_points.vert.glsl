#version 300 es
// The same points as are drawn, for whoever wants to read them back: a vertex each, by transform feedback.
precision highp float;
precision highp int;
#include "strand.glsl"
layout(location = 0) in vec4 aPlace;
layout(location = 1) in uvec4 aWisp;
layout(location = 2) in float aParameter;
out vec3 vPosition;
void main() {
    Strand s = Strand(int(aWisp.x), int(aWisp.y), int(aWisp.z), aPlace.xy, aPlace.z, aPlace.w);
    vPosition = strandPoint(s, aParameter).position;
    gl_Position = vec4(0.0);
}
