import type { HairView } from "../draw/hair_view";
import { element, replaceChildren } from "../ui/dom";
import { Plot } from "../ui/plot";
import { contactPoint, isPenetration, isWithBody, kContactKinds, otherWisp, type Contact } from "./contacts";
import { kContactColours, channels } from "./figures";
import type { Run } from "./run";

const kLongest = 0.06; // [m] of an arrow
const kListed = 40; // contacts of a group; the others are counted

/** Contacts of one kind with one partner. */
interface Group {
    key: string;
    partner: number; // wisp; −1: itself or a body
    contacts: Contact[];
    strength: number; // of all
}

/** "Why did this move?": what acts on the selected wisp in this frame, and how it fares over the run. */
export class WispPanel {
    readonly root = element("section", { id: "wisp" });
    private readonly figures = element("dl");
    private readonly contacts = element("div");
    private plots: Plot[] = [];
    private wisp = -1;

    constructor(
        private readonly run: Run,
        private readonly view: HairView,
        private readonly select: (wisp: number) => void,
        private readonly seek: (frame: number) => void,
    ) {
        this.setWisp(-1);
    }

    setWisp(wisp: number): void {
        this.wisp = wisp;
        this.root.classList.toggle("selected", wisp >= 0);
        if (wisp < 0) {
            this.view.marks.clear();
            this.view.touch();
            replaceChildren(this.root, element("h2", {}, "Why did this move?"),
                element("p", { class: "hint" }, "Click a wisp to see its contacts in this frame, and its stretch, radii and energy over time."));
            return;
        }
        this.plots = this.makePlots();
        replaceChildren(this.root,
            element("button", { type: "button", class: "button close", title: "Back to all wisps (Esc)", onclick: () => this.select(-1) }, "×"),
            element("h2", {}, `Wisp ${wisp}`),
            this.figures,
            ...this.plots.map((p) => p.root),
            this.contacts,
        );
    }

    /** Shows a frame that the view has already been given. */
    show(frame: number): void {
        if (this.wisp < 0) return;
        const { run, wisp } = this,
            first = run.hair.firstSection[wisp],
            tip = run.hair.firstSection[wisp + 1] - 1;
        let length = 0;
        for (let s = first + 1; s < tip; ++s) length += run.segmentLength(frame, s);
        replaceChildren(this.figures,
            ...Object.entries({
                segments: String(tip - first - 1),
                length: `${(100 * length).toFixed(1)} cm`,
            }).flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
        );
        for (const plot of this.plots) plot.show(frame);
        this.showContacts(frame);
    }

    private makePlots(): Plot[] {
        const { run, wisp } = this,
            first = run.hair.firstSection[wisp],
            tip = run.hair.firstSection[wisp + 1] - 1,
            k = run.hair.envelopePoints;
        const overFrames = (of: (frame: number) => number) => Float32Array.from({ length: run.frames }, (_, i) => of(i));
        const stretch = overFrames((frame) => {
            let most = 0;
            for (let s = first + 1; s < tip; ++s) most = Math.max(most, run.segmentLength(frame, s) / run.restLength[s] - 1);
            return 100 * most;
        });
        const radii = (choose: (values: number[]) => number) =>
            overFrames((frame) => {
                const values: number[] = [];
                for (let s = first + 2; s <= tip; ++s) {
                    let designed = 0;
                    for (let i = 0; i < k; ++i) designed += run.designedRadius[k * s + i] / k;
                    values.push((100 * run.meanRadius(frame, s)) / designed);
                }
                return choose(values);
            });
        const energy = run.wispSeries.find((s) => s.name === "kinetic energy")!;
        const plot = (title: string, tip_: string, unit: string, curves: [string, Float32Array, string][], format: (v: number) => string) =>
            new Plot({
                title, tip: tip_, unit, format, seek: this.seek,
                curves: curves.map(([name, values, colour]) => ({ name, values, colour })),
            });
        return [
            plot("stretch", "the most stretched segment, over its rest length", "%", [["", stretch, "#e0a458"]], (v) => v.toFixed(2)),
            plot("radii", "mean radius of its cross-sections, of the design's: mean and least", "%", [
                ["mean", radii((v) => v.reduce((a, b) => a + b, 0) / v.length), "#9bc27e"],
                ["least", radii((v) => Math.min(...v)), "#6b8a55"],
            ], (v) => v.toFixed(0)),
            plot("energy", "kinetic energy of its skeleton and envelope", "mJ", [
                ["", overFrames((i) => 1000 * energy.values[i * run.hair.wisps + wisp]), "#6fb3d2"],
            ], (v) => v.toPrecision(3)),
        ];
    }

    private showContacts(frame: number): void {
        const { run, wisp, view } = this;
        view.marks.clear();
        view.touch();
        if (!run.contacts) {
            replaceChildren(this.contacts, element("p", { class: "hint" },
                "Its contacts were not recorded. Simulate with `mane simulate SCENE.toml -o FILE.mane --record` and write the page again to see them."));
            return;
        }
        const list = run.contacts.ofWisp(frame, run.hair, wisp);
        this.mark(list, frame);
        const open = new Set([...this.contacts.querySelectorAll("details[open]")].map((d) => d.getAttribute("data-group")));
        replaceChildren(this.contacts,
            element("h2", {}, `${list.length || "No"} contacts in this frame`),
            element("div", { class: "contacts" }, ...this.groups(list).map((g) => this.describeGroup(g, open))),
        );
    }

    /** By kind and partner; the strongest first, penetration reactions before all. */
    private groups(list: readonly Contact[]): Group[] {
        const groups = new Map<string, Group>();
        for (const contact of list) {
            const partner = this.partnerOf(contact),
                key = `${kContactKinds[contact.kind]} with ${partner.name}`;
            const group = groups.get(key) ?? { key, partner: partner.wisp, contacts: [], strength: 0 };
            group.contacts.push(contact);
            group.strength += contact.strength;
            groups.set(key, group);
        }
        const rank = (g: Group) => (isPenetration(g.contacts[0]) ? 1e6 + g.strength : g.strength);
        return [...groups.values()].sort((a, b) => rank(b) - rank(a));
    }

    private partnerOf(contact: Contact): { name: string; wisp: number } {
        const { run, wisp } = this;
        if (isWithBody(contact)) return { name: run.bodies[contact.body]?.name ?? "a body", wisp: -1 };
        const other = otherWisp(run.hair, contact, wisp);
        return other === wisp ? { name: "itself", wisp: -1 } : { name: `wisp ${other}`, wisp: other };
    }

    private describeGroup(group: Group, open: ReadonlySet<string | null>): HTMLElement {
        const { contacts, partner } = group;
        const go = partner >= 0 && element("button", {
            type: "button", class: "button go", title: `go to wisp ${partner}`,
            onclick: (e: Event) => {
                e.preventDefault();
                this.select(partner);
            },
        }, "→");
        const details = element("details", { open: open.has(group.key), "data-group": group.key },
            element("summary", {},
                element("span", {}, group.key),
                element("span", { class: "count" }, contacts.length > 1 ? `× ${contacts.length}` : ""),
                element("span", { class: "strength" }, strengthOf(contacts[0], group.strength)),
                go || element("span")),
            element("ul", {}, ...contacts.slice(0, kListed).map((c) => this.describe(c))),
            contacts.length > kListed && element("p", { class: "hint" }, `and ${contacts.length - kListed} weaker ones`),
        );
        details.style.setProperty("--colour", kContactColours[contacts[0].kind]);
        return details;
    }

    /** One contact: which point, where, how strong. */
    private describe(contact: Contact): HTMLElement {
        const owner = this.ownerOf(contact),
            section = contact.section - this.run.hair.firstSection[owner];
        const point = contact.point === 0 ? `skeleton point of section ${section}`
            : contact.point === 255 ? `between sections ${section} and ${section + 1}`
            : `envelope point ${contact.point} of section ${section}`;
        return element("li", {},
            element("span", {}, point,
                owner === this.wisp ? "" : ` of wisp ${owner}`,
                isWithBody(contact) ? `, polygon ${contact.other}` : ""),
            element("span", { class: "strength" }, strengthOf(contact, contact.strength)));
    }

    private ownerOf(contact: Contact): number {
        const { firstSection } = this.run.hair;
        const own = contact.section >= firstSection[this.wisp] && contact.section < firstSection[this.wisp + 1];
        return own ? this.wisp : otherWisp(this.run.hair, contact, this.wisp);
    }

    /** Dots where the contacts are, arrows for what they do to this wisp: the strongest `kLongest` long. */
    private mark(list: readonly Contact[], frame: number): void {
        const { run, view } = this,
            marks = view.marks,
            shown = run.frame(frame),
            records = view.sectionRecords.values;
        const most = [false, true].map((penetration) =>
            list.reduce((m, c) => (isPenetration(c) === penetration ? Math.max(m, c.strength) : m), 0));
        for (const contact of list) {
            const p = contactPoint(run.hair, shown, records, contact);
            const [r, g, b] = channels(kContactColours[contact.kind]);
            const share = Math.sqrt(contact.strength / (most[Number(isPenetration(contact))] || 1));
            marks.dot(p, -(3 + 4 * share), [r, g, b, 0.9]);
            // The other side got the opposite.
            const sign = this.ownerOf(contact) === this.wisp ? 1 : -1;
            if (share > 0.15)
                marks.arrow(p, p.map((x, i) => x + sign * contact.direction[i] * kLongest * share), 2, 0.35, [r, g, b, 0.95]);
        }
    }
}

/** A strength as people read it: of one contact, or of several like it. */
function strengthOf(like: Contact, s: number): string {
    if (isPenetration(like)) return `moved ${(1000 * s).toPrecision(2)} mm`;
    return s === 0 ? "0 N·s" : s < 1e-6 ? `${(1e9 * s).toPrecision(3)} nN·s` : s < 1e-3 ? `${(1e6 * s).toPrecision(3)} µN·s` : `${(1e3 * s).toPrecision(3)} mN·s`;
}
