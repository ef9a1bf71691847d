#version 300 es
precision highp float;
in vec3 vRadiance;
in float vCoverage;
flat in float vChance;
uniform float uPass;
out vec4 oRadiance;

// What covers a part of a pixel covers the whole of it in so many of the passes, each strand in others.
void main() {
    float pixel = 52.9829189 * fract(dot(gl_FragCoord.xy + 5.588238 * uPass, vec2(0.06711056, 0.00583715)));
    float chance = fract(pixel + vChance);
    if (vCoverage < chance) discard;
    oRadiance = vec4(vRadiance, 1.0);
}
