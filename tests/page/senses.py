"""Sound, gamepad and ring of a pop: stand-ins that write down what the page does with them."""

# For `opened`. window.heard: sounds that began; window.rumbled: effects of the gamepad; window.pad: the gamepad.
STUBS = """
  window.heard = [];
  window.rumbled = [];
  class Param {
    value = 0;
    setValueAtTime() {}
    setTargetAtTime() {}
    exponentialRampToValueAtTime() {}
  }
  class Node_ {
    constructor(context, options = {}) { Object.assign(this, {gain: new Param(), frequency: new Param(), options}); }
    connect(next) { return next; }
    stop() {}
  }
  window.AudioContext = class {
    state = "running"; currentTime = 0; sampleRate = 1000; destination = new Node_();
    createBuffer(_, length) { return {getChannelData: () => new Float32Array(length)}; }
    async resume() {}
    async suspend() {}
  };
  window.GainNode = window.BiquadFilterNode = window.IIRFilterNode = Node_;
  window.AudioBufferSourceNode = class extends Node_ {
    start() { window.heard.push(this.options.loop ? "friction" : "click"); }
  };
  window.OscillatorNode = class extends Node_ { start() { window.heard.push("thump"); } };
  const vibrationActuator = {async playEffect(kind, effect) { window.rumbled.push([kind, effect]); }};
  const buttons = Array.from({length: 17}, () => ({value: 0}));
  window.pad = {connected: true, id: "Pad (STANDARD)", axes: [0, 0, 0, 0], buttons, vibrationActuator};
  navigator.getGamepads = () => [window.pad];
"""

# After it, window.rings is how often the view began to show a ring.
COUNT_RINGS = """() => {
  const ring = document.querySelector(".pop-ring");
  let shown = ring.style.display !== "none";
  window.rings = 0;
  new MutationObserver(() => {
    const now = ring.style.display !== "none";
    if (now && !shown) window.rings++;
    shown = now;
  }).observe(ring, {attributes: true, attributeFilter: ["style"]});
}"""
