#version 300 es
precision highp float;
uniform highp sampler2D uPicture;
out vec4 oRadiance;
void main() {
    oRadiance = texelFetch(uPicture, ivec2(gl_FragCoord.xy), 0);
}
