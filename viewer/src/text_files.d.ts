/** A scene's text (build.mjs). */
declare module "*.toml" {
    const text: string;
    export default text;
}
