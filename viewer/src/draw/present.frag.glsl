#version 300 es
// The mean of the pictures added, over the background, as the screen shows it.
precision highp float;
uniform highp sampler2D uPicture;
uniform float uShare; // one over how many pictures
uniform vec3 uBackgroundMiddle, uBackgroundRim;
uniform vec2 uViewport;
uniform bool uTransparent;
out vec4 oColour;

vec3 encoded(vec3 x) {
    x = mix(x, 0.6 + 0.4 * (1.0 - exp(-(x - 0.6) / 0.4)), step(0.6, x)); // highlights roll off
    return mix(12.92 * x, 1.055 * pow(max(x, 1e-5), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}
float dither(vec2 p) { // or smooth shades would show steps
    return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main() {
    vec4 sum = texelFetch(uPicture, ivec2(gl_FragCoord.xy), 0) * uShare;
    vec2 fromMiddle = (gl_FragCoord.xy / uViewport - vec2(0.5, 0.55)) * 2.0;
    vec3 background = mix(uBackgroundMiddle, uBackgroundRim, smoothstep(0.0, 1.5, length(fromMiddle)));
    if (uTransparent) {
        oColour = vec4(encoded(sum.rgb / max(sum.a, 1e-4)) * sum.a, sum.a);
        return;
    }
    oColour = vec4(encoded(sum.rgb + background * (1.0 - sum.a)) + dither(gl_FragCoord.xy) / 255.0, 1.0);
}
