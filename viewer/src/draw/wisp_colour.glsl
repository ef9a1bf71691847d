// Neighbouring numbers get hues far apart: steps of the golden ratio round the circle.
vec3 wispColour(int wisp) {
    float hue = 6.0 * fract(float(wisp) * 0.61803399);
    vec3 d = abs(hue - vec3(0.0, 2.0, 4.0));
    return 0.13 + 0.37 * clamp(2.0 - min(d, 6.0 - d), 0.0, 1.0);
}
