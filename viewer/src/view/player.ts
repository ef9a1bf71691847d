/** A clock that goes over the frames of a run. */
export class Player {
    playing = false;
    looping = true;
    speed = 1; // [1] of real time
    private at = 0; // [frames]

    constructor(
        readonly frames: number,
        private readonly frameRate: number,
    ) {}

    /** [frames] between frames too. */
    get position(): number {
        return this.at;
    }
    get frame(): number {
        return Math.floor(this.at);
    }

    seek(frame: number): void {
        this.at = Math.min(Math.max(frame, 0), this.frames - 1);
    }
    step(by: number): void {
        this.playing = false;
        this.seek(this.frame + by);
    }
    toggle(): void {
        if (!this.playing && this.frame === this.frames - 1) this.at = 0;
        this.playing = !this.playing && this.frames > 1;
    }

    /** `seconds` have passed. */
    advance(seconds: number): void {
        if (!this.playing) return;
        this.at += seconds * this.frameRate * this.speed;
        if (this.at < this.frames) return;
        if (this.looping) this.at %= this.frames;
        else {
            this.at = this.frames - 1;
            this.playing = false;
        }
    }
}
