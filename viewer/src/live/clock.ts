/**
 * Keeps simulated time at the pace of real time. Who falls behind by more than a moment does not hurry to catch up: the run then goes
 * as fast as it can.
 */
export class Clock {
    private begin = 0; // [ms] when simulated time was zero

    /** Real time `now` [ms] is simulated time `time` [s]. */
    set(now: number, time: number): void {
        this.begin = now - 1000 * time;
    }

    /** How long [ms] until simulated time `time` [s] is due. */
    wait(now: number, time: number): number {
        const moment = 100;
        const wait = this.begin + 1000 * time - now;
        if (wait < -moment) this.begin -= wait;
        return Math.max(0, wait);
    }
}
