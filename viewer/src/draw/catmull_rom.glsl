// The four weights of a Catmull-Rom piece at t, for the points before, at its ends and behind; and their derivatives.
vec4 catmullRom(float t) {
    float t2 = t * t, t3 = t2 * t;
    return 0.5 * vec4(-t + 2.0 * t2 - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2);
}
vec4 catmullRomSlope(float t) {
    float t2 = t * t;
    return 0.5 * vec4(-1.0 + 4.0 * t - 3.0 * t2, -10.0 * t + 9.0 * t2, 1.0 + 8.0 * t - 9.0 * t2, 3.0 * t2 - 2.0 * t);
}
