import { button, element, type Panel } from "../../panel.ts";
import { onePerApp } from "../../state/app.ts";
import { remember, remembered } from "../../state/remembered.ts";
import { Signal } from "../../state/signal.ts";

const LOUD_WATT = 0.012; // W, full volume: friction of 0.5 N at 25 mm/s
const FOLLOW_S = 0.03;
const CLICK_S = 0.09;
const FULL_DROP = 0.5; // N
const GESTURES = ["mousedown", "pointerup", "keydown"] as const; // with which a browser lets a page play sound

/**
 * Plays friction as noise and pops as clicks. The volume follows the friction's power and the pop's drop. The audio
 * context is created when sound is first switched on.
 */
class Sound {
  /** The user's answer; null before it. This browser remembers it. */
  readonly wanted = new Signal<boolean | null>(null);
  private context: AudioContext | null = null;
  private friction: GainNode | null = null;
  private tone: BiquadFilterNode | null = null;
  private master: GainNode | null = null;
  private noise: AudioBuffer | null = null;
  private volume = 0.6;

  constructor() {
    const answer = remembered("sound");
    if (answer !== null) this.wanted.value = answer === "on";
    if (this.wanted.value) this.startAtGesture();
  }

  get on(): boolean {
    return this.context?.state === "running";
  }

  /** Call it from a click: browsers block sound that the user did not start. */
  async switchOn(): Promise<void> {
    this.answer(true);
    await this.start();
  }
  async switchOff(): Promise<void> {
    this.answer(false);
    await this.context?.suspend();
  }

  private answer(on: boolean): void {
    remember("sound", on ? "on" : "off");
    this.wanted.value = on;
  }

  private async start(): Promise<void> {
    if (!this.context) this.make();
    await this.context?.resume();
  }

  /** A sound that an earlier visit asked for begins with the first click or key of this one. */
  private startAtGesture(): void {
    const begin = (): void => {
      for (const type of GESTURES) document.removeEventListener(type, begin, true);
      if (this.wanted.value) void this.start().catch(() => {});
    };
    for (const type of GESTURES) document.addEventListener(type, begin, true);
  }

  /** 0 to 1. */
  set loudness(volume: number) {
    this.volume = volume;
    if (this.master && this.context) this.master.gain.setTargetAtTime(volume ** 2, this.context.currentTime, FOLLOW_S);
  }

  private make(): void {
    const context = new AudioContext();
    const noise = context.createBuffer(1, 2 * context.sampleRate, context.sampleRate);
    const samples = noise.getChannelData(0);
    for (let i = 0; i < samples.length; i++) samples[i] = 2 * Math.random() - 1;
    this.master = new GainNode(context, { gain: this.volume ** 2 });
    this.tone = new BiquadFilterNode(context, { type: "bandpass", frequency: 700, Q: 0.7 });
    this.friction = new GainNode(context, { gain: 0 });
    const source = new AudioBufferSourceNode(context, { buffer: noise, loop: true });
    source.connect(this.tone).connect(this.friction).connect(this.master).connect(context.destination);
    source.start();
    this.context = context;
    this.noise = noise;
  }

  /** power: W. */
  setFriction(power: number): void {
    if (!this.context || !this.friction || !this.tone) return;
    const loud = Math.min(1, power / LOUD_WATT) ** 0.6;
    this.friction.gain.setTargetAtTime(0.5 * loud, this.context.currentTime, FOLLOW_S);
    this.tone.frequency.setTargetAtTime(500 + 1300 * loud, this.context.currentTime, FOLLOW_S);
  }

  /** drop: N. */
  click(drop: number): void {
    if (!this.context || !this.noise || !this.master || !this.on) return;
    const now = this.context.currentTime;
    const loud = 0.25 + 0.75 * Math.min(1, Math.abs(drop) / FULL_DROP);
    const burst = new AudioBufferSourceNode(this.context, { buffer: this.noise });
    const body = new BiquadFilterNode(this.context, { type: "lowpass", frequency: 1800 });
    const fade = new GainNode(this.context, { gain: loud });
    fade.gain.setValueAtTime(loud, now);
    fade.gain.exponentialRampToValueAtTime(0.001, now + CLICK_S);
    burst.connect(body).connect(fade).connect(this.master);
    burst.start(now, Math.random());
    burst.stop(now + CLICK_S);
    const thump = new OscillatorNode(this.context, { frequency: 150 });
    const low = new GainNode(this.context, { gain: 0.7 * loud });
    low.gain.exponentialRampToValueAtTime(0.001, now + CLICK_S);
    thump.frequency.exponentialRampToValueAtTime(60, now + CLICK_S);
    thump.connect(low).connect(this.master);
    thump.start(now);
    thump.stop(now + CLICK_S);
  }
}

/** The sound of this page. */
export const soundOf = onePerApp(() => new Sound());

/**
 * Asks once, after the first pop, whether the page may play sound. The answer is remembered. The question is a bar
 * below the page.
 */
export const askSound: Panel = (root, app) => {
  const sound = soundOf(app);
  const yes = (): void => {
    void sound.switchOn().catch(() => app.notify("This browser does not let the page play sound."));
  };
  const box = element(
    "section",
    { class: "ask-sound", "aria-label": "Sound", hidden: true },
    element("p", {}, "Do you want to hear the pops and the friction?"),
    button("Sound on", "", yes, "primary"),
    button("No sound", "", () => void sound.switchOff()),
  );
  root.after(box);
  let popped = false;
  const show = (): void => {
    box.hidden = !popped || sound.wanted.value !== null || app.sitting.value !== null;
  };
  app.live.events.watch((events) => {
    popped ||= events.some(({ what }) => what === "pop");
    show();
  });
  sound.wanted.watch(show);
};
