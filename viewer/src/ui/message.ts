import { element } from "./dom";

/** A message over the page: what happened, and what to do about it. Closed by a click where the page can go on. */
export function showMessage(title: string, text: string, closable: boolean): void {
    document.querySelector(".message")?.remove();
    const box = element("div", { class: "message", role: "alert" }, element("h1", {}, title), element("p", {}, text));
    if (closable) box.append(element("button", { type: "button", class: "button", onclick: () => box.remove() }, "Close"));
    document.body.append(box);
}
