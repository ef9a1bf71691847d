// How different two pictures look, worked out in a page of the browser, which decodes PNGs: CIELAB of both after a blur of about
// what an eye blurs at arm's length, so that noise of single pixels counts little and shapes and colours much.

/** { mean, worst }: mean ΔE, and that of the worst of all blocks of 16 × 16 pixels. `a`, `b`: PNGs. */
export async function perceptualDifference(page, a, b) {
    return page.evaluate(async ([first, second]) => {
        const kBlock = 16;
        async function lab(base64) {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
            const canvas = new OffscreenCanvas(image.width, image.height);
            const context = canvas.getContext("2d");
            context.filter = "blur(1.5px)";
            context.drawImage(image, 0, 0);
            const { data } = context.getImageData(0, 0, image.width, image.height);
            const out = new Float32Array(3 * image.width * image.height);
            const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
            const f = (t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116);
            for (let i = 0; i < out.length / 3; ++i) {
                const [r, g, b] = [0, 1, 2].map((c) => linear(data[4 * i + c] / 255));
                const x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505),
                    y = f(0.2126 * r + 0.7152 * g + 0.0722 * b),
                    z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
                out.set([116 * y - 16, 500 * (x - y), 200 * (y - z)], 3 * i);
            }
            return { width: image.width, height: image.height, lab: out };
        }
        const [p, q] = [await lab(first), await lab(second)];
        if (p.width !== q.width || p.height !== q.height) return { mean: Infinity, worst: Infinity };
        const columns = Math.ceil(p.width / kBlock);
        const sums = new Float64Array(columns * Math.ceil(p.height / kBlock)),
            counts = new Float64Array(sums.length);
        for (let i = 0; i < p.width * p.height; ++i) {
            const block = Math.floor(Math.floor(i / p.width) / kBlock) * columns + Math.floor((i % p.width) / kBlock);
            sums[block] += Math.hypot(...[0, 1, 2].map((c) => p.lab[3 * i + c] - q.lab[3 * i + c]));
            ++counts[block];
        }
        const mean = sums.reduce((a, b) => a + b) / (p.width * p.height);
        return { mean, worst: Math.max(...sums.map((s, i) => s / counts[i])) };
    }, [a.toString("base64"), b.toString("base64")]);
}
