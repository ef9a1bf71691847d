/** Elements without a framework. */

type Child = Node | string | null | undefined | false;
type Properties = Record<string, unknown>;

/** An element with properties (`class`, `title`, `onclick`, `data-…`, `aria-…`) and children. */
export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    properties: Properties = {},
    ...children: Child[]
): HTMLElementTagNameMap[K] {
    const e = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (value === undefined || value === false) continue;
        if (name === "class") e.className = String(value);
        else if (name.includes("-")) e.setAttribute(name, String(value));
        else Object.assign(e, { [name]: value });
    }
    e.append(...children.filter((c): c is Node | string => c instanceof Node || typeof c === "string"));
    return e;
}

export function replaceChildren(parent: Element, ...children: Child[]): void {
    parent.replaceChildren(...children.filter((c): c is Node | string => c instanceof Node || typeof c === "string"));
}
