// The encoder: values of one message as a form and as the command's words, and the frame they make.
"use strict";

function makeEncoder({ codec, changed, decode }) {
  const chooser = byId("message"), words = byId("words"), output = byId("encoded");
  const problem = byId("encoder-problem"), copy = byId("copy-frame"), send = byId("decode-frame");
  let kind = null, fields = null, frame = null;

  function choose(name, values) {
    kind = codec.kinds.find((each) => each.name === name) || codec.kinds[0];
    chooser.value = kind.name;
    fields = makeFields(codec, kind, { values: values || kind.example, onInput: fromFields });
    byId("values").replaceChildren(fields.element);
    byId("no-values").hidden = kind.given.length > 0;
    byId("words-of").hidden = kind.given.length === 0;
    fromFields();
  }

  function fromFields() {
    try {
      const values = fields.values();
      words.value = writeNotation(kind, values);
      report(values);
    } catch (error) {
      refuse(error);
    }
  }

  function fromWords() {
    try {
      const values = readNotation(kind, words.value);
      fields.show(values);
      report(values);
    } catch (error) {
      refuse(error);
      words.setAttribute("aria-invalid", "true");
      if (error.size) {
        problem.append(" ", button("Show the place", () => {
          words.focus();
          words.setSelectionRange(error.at, error.at + error.size);
        }));
      }
    }
  }

  function report(values) {
    words.setAttribute("aria-invalid", "false");
    try {
      frame = codec.encode(kind.name, values);
    } catch (error) {
      refuse(error);
      return;
    }
    fields.mark(null);
    problem.replaceChildren();
    tell();
  }

  function refuse(error) {
    if (!(error instanceof Unusable)) throw error;
    frame = null;
    fields.mark(error);
    problem.replaceChildren(error.message);
    tell();
  }

  function tell() {
    const hex = frame ? toHex(frame) : "";
    output.textContent = hex;
    copy.dataset.copy = hex;
    copy.disabled = send.disabled = !frame;
    document.dispatchEvent(new CustomEvent("encoded", { detail: { message: kind.name, bytes: frame } }));
    changed();
  }

  chooser.addEventListener("change", () => choose(chooser.value));
  words.addEventListener("input", fromWords);
  send.addEventListener("click", () => decode(frame));

  return {
    choose,
    // Take the words of an address; what is wrong with them is said.
    open(name, text) {
      choose(name);
      if (text === null) return;
      words.value = text;
      fromWords();
    },
    state: () => ({ message: kind.name, kind, words: kind.given.length ? words.value : null }),
    frame: () => frame,
  };
}
