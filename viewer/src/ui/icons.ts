/** Small pictures for buttons, drawn so that no font has to have them. */
const kPaths = {
    play: "M4 2.5v11l9-5.5z",
    pause: "M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z",
    back: "M12.5 2.5v11l-7-5.5zM3.5 2.5h2v11h-2z",
    on: "M3.5 2.5v11l7-5.5zM10.5 2.5h2v11h-2z",
    again: "M8 3a5 5 0 1 0 4.8 3.6l-1.9.6A3 3 0 1 1 8 5v2.5L12 4 8 .5z",
};

export function icon(name: keyof typeof kPaths): SVGElement {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("viewBox", "0 0 16 16");
    svg.setAttribute("class", "icon");
    svg.setAttribute("data-icon", name);
    const path = document.createElementNS(svg.namespaceURI, "path");
    path.setAttribute("d", kPaths[name]);
    svg.append(path);
    return svg;
}
