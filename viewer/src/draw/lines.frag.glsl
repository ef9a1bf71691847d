#version 300 es
precision highp float;
in vec4 vColour;
in vec3 vAcross;
uniform bool uLinear; // into the film, opaque; else onto the screen, with soft edges
out vec4 oColour;
void main() {
    float edge = vAcross.z - length(vAcross.xy);
    if (uLinear) {
        if (edge < 0.0) discard;
        oColour = vec4(pow(vColour.rgb, vec3(2.2)), 1.0);
    } else {
        float opacity = vColour.a * clamp(edge + 0.5, 0.0, 1.0);
        oColour = vec4(vColour.rgb * opacity, opacity);
    }
}
