// The settings of a line, as their fields have them.
"use strict";

// `data` is what line_data.py says.
function makeLineSettings(data) {
  const [baud, timeout, listen, echo] = ["baud", "timeout", "listen", "echo"]
    .map((name) => document.getElementById(`line-${name}`));
  const numbers = [baud, timeout], chooser = document.getElementById("line-limits");
  const { choices } = makeLimits(data);
  const isWhole = (field) => field.validity.valid && Number.isInteger(field.valueAsNumber);

  // What the port is opened with.
  function ofPort() {
    const { dataBits, stopBits, parity } = data;
    return { baudRate: baud.valueAsNumber, dataBits, stopBits, parity, flowControl: "none" };
  }

  // What makeSession needs.
  function ofSession() {
    return {
      direction: listen.value === "any" ? null : data.received,
      baud: baud.valueAsNumber,
      localEcho: echo.checked,
      timeout: timeout.valueAsNumber,
    };
  }

  // The limits of what is sent, which may change while the line is open.
  const limits = () => (choices.length ? choices[chooser.selectedIndex].bounds : null);

  function offerLimits() {
    chooser.replaceChildren(...choices.map(({ text }) => new Option(text)));
    chooser.closest("p").hidden = !choices.length;
  }

  function show() {
    const { baudRate, dataBits, stopBits, parity } = ofPort();
    const rate = isWhole(baud) ? `${baudRate} baud` : "no rate";
    document.getElementById("line-summary").textContent = `${rate}, ${dataBits} data bits, `
      + `${parity === "none" ? "no" : parity} parity, ${stopBits} stop bit${stopBits > 1 ? "s" : ""}`
      + (echo.checked ? ", local echo" : "");
    for (const field of numbers) field.setAttribute("aria-invalid", String(!isWhole(field)));
  }

  // What is wrong with them, where the focus goes then; nothing where they can be used.
  function problem() {
    show();
    const wrong = numbers.find((field) => !isWhole(field));
    if (!wrong) return "";
    wrong.closest("details").open = true;
    wrong.focus();
    return wrong === baud
      ? `The rate of the line is a whole number of bits per second, such as ${data.baud}.`
      : `The time for a reply is a whole number of milliseconds, such as ${REPLY_TIMEOUT_MS}.`;
  }

  function disable(isDisabled) {
    for (const field of [...numbers, listen, echo]) field.disabled = isDisabled;
  }

  for (const field of [...numbers, echo]) field.addEventListener("input", show);
  if (data.received === null) listen.value = "any";
  offerLimits();
  show();
  return { ofPort, ofSession, limits, problem, disable };
}
