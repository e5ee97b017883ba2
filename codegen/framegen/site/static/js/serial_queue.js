// Messages that wait to be sent until the question before them is answered, or given up.
"use strict";

// More do not wait: whoever presses so often sees that nothing answers.
const QUEUE_BOUND = 16;

// `isBusy(message)` says whether the line cannot take it yet, `hand(message)` sends it.
function makeSendQueue(isBusy, hand) {
  const held = [];

  // Send what can be sent, in order.
  function pump() {
    while (held.length && !isBusy(held[0])) hand(held.shift());
  }

  return {
    pump,

    // Send a message as soon as the line takes it; how many wait then, or null where it is one too many.
    add(message) {
      if (held.length >= QUEUE_BOUND) return null;
      held.push(message);
      pump();
      return held.length;
    },

    // Forget those that wait, and return them.
    clear: () => held.splice(0),
  };
}
