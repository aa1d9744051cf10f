// A run that goes on while it is watched: what has grown is asked for, and the run can be paused, stepped and stopped.

class Live {
    constructor(run, playback, renewed) {
        Object.assign(this, { run, playback, renewed });
        if (!run.served || !run.meta.live) return;
        byId("live").hidden = false;
        for (const button of byId("live").querySelectorAll("button")) button.addEventListener("click", () => this.control(button.value));
        this.again();
    }

    async control(word) {
        try {
            await fetch("control", { method: "POST", body: word });
            write(byId("live-state"), { pause: "paused", resume: "running", step: "paused", stop: "stopping" }[word]);
        } catch (error) {
            tell(error);
        }
    }

    again() {
        setTimeout(() => this.ask(), 500);
    }

    async ask() {
        try {
            const meta = await readMeta(), grown = meta.frames.time.length > this.run.frames;
            this.run.renew(meta);
            this.renewed(grown);
            if (meta.live) this.again();
            else {
                write(byId("live-state"), "ended");
                for (const button of byId("live").querySelectorAll("button")) button.disabled = true;
            }
        } catch (error) {
            write(byId("live-state"), "the server does not answer");
        }
    }
}
