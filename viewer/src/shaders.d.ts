/** A shader's text, its `#include` lines replaced (build.mjs). */
declare module "*.glsl" {
    const text: string;
    export default text;
}
