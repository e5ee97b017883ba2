// A navigator.serial whose ports are at the other end of `host`: {choose, open, write, read, close}, each of
// which returns a promise. It keeps to the Web Serial API: streams with locks, errors of the line after
// which a new stream is to be had, fatal ones after which there is none, and a new port after replugging.
"use strict";

function makeFakeSerial(host, pause = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); })) {
  const lost = () => new DOMException("The device has been lost.", "NetworkError");

  class FakePort extends EventTarget {
    #id; #info; #state = "closed"; #readable = null; #writable = null; #source = null; #sink = null;
    #isReadFatal = false; #isWriteFatal = false;

    connected = true;

    constructor(id, info) {
      super();
      [this.#id, this.#info] = [id, info];
    }

    getInfo() { return { ...this.#info }; }

    async open(options) {
      if (this.#state !== "closed") throw new DOMException("The port is already open.", "InvalidStateError");
      const { baudRate, dataBits = 8, stopBits = 1, parity = "none", bufferSize = 255 } = options;
      if (!(Number.isInteger(baudRate) && baudRate > 0)) throw new TypeError("baudRate");
      if (![7, 8].includes(dataBits) || ![1, 2].includes(stopBits)) throw new TypeError("dataBits or stopBits");
      if (!["none", "even", "odd"].includes(parity) || bufferSize <= 0) throw new TypeError("parity or bufferSize");
      this.#state = "opening";
      const refused = await host.open(this.#id, { baudRate, dataBits, stopBits, parity });
      if (refused || !this.connected) {
        this.#state = "closed";
        throw new DOMException("Failed to open serial port.", "NetworkError");
      }
      [this.#state, this.#isReadFatal, this.#isWriteFatal] = ["opened", false, false];
      this.#pump();
    }

    get readable() {
      if (this.#state !== "opened" || this.#isReadFatal) return null;
      this.#readable ??= new ReadableStream({
        start: (controller) => { this.#source = controller; },
        cancel: () => { [this.#readable, this.#source] = [null, null]; },
      });
      return this.#readable;
    }

    get writable() {
      if (this.#state !== "opened" || this.#isWriteFatal) return null;
      this.#writable ??= new WritableStream({
        start: (controller) => { this.#sink = controller; },
        write: async (chunk, { signal }) => {
          if (!ArrayBuffer.isView(chunk) && !(chunk instanceof ArrayBuffer)) throw new TypeError("chunk");
          const refused = await this.#unlessAborted(signal, host.write(this.#id, [...new Uint8Array(chunk)]));
          if (!refused) return;
          [this.#writable, this.#sink] = [null, null];
          throw new DOMException("The write has failed.", refused);
        },
        close: () => { [this.#writable, this.#sink] = [null, null]; },
        abort: () => { [this.#writable, this.#sink] = [null, null]; },
      });
      return this.#writable;
    }

    #unlessAborted(signal, result) {
      return new Promise((resolve, reject) => {
        const abort = () => reject(signal.reason ?? lost());
        signal.addEventListener("abort", abort);
        result.then(resolve, reject).finally(() => signal.removeEventListener("abort", abort));
      });
    }

    async close() {
      if (this.#state !== "opened") throw new DOMException("The port is already closed.", "InvalidStateError");
      const [readable, writable] = [this.#readable, this.#writable];
      if (readable?.locked || writable?.locked) throw new TypeError("Cannot close a port whose stream is locked.");
      this.#state = "closing";
      await Promise.all([readable?.cancel(), writable?.abort()]);
      await host.close(this.#id);
      this.#state = "closed";
    }

    async forget() { await this.close().catch(() => {}); }

    // What the other end says comes in pieces: {bytes}, or {error} that may be {fatal}.
    async #pump() {
      while (this.#state === "opened" && this.connected) {
        for (const { bytes, error, fatal } of await host.read(this.#id)) {
          if (this.#state !== "opened") return;
          if (error) this.#fail(new DOMException("The line has an error.", error), fatal);
          else if (this.readable) this.#source.enqueue(Uint8Array.from(bytes));
          await pause(0);
        }
        await pause(2);
      }
    }

    #fail(error, fatal) {
      const source = this.readable && this.#source;
      [this.#readable, this.#source, this.#isReadFatal] = [null, null, Boolean(fatal)];
      source?.error(error);
    }

    // The cable is pulled.
    vanish() {
      this.connected = false;
      const sink = this.#sink;
      this.#fail(lost(), true);
      [this.#writable, this.#sink, this.#isWriteFatal] = [null, null, true];
      sink?.error(lost());
    }
  }

  class FakeSerial extends EventTarget {
    #ports = new Map();

    async requestPort() {
      const found = await host.choose();
      if (found === null) throw new DOMException("No port selected by the user.", "NotFoundError");
      return this.port(found);
    }

    async getPorts() { return [...this.#ports.values()]; }

    // The port with such an {id, info}, which the user has allowed.
    port({ id, info }) {
      if (!this.#ports.has(id)) this.#ports.set(id, new FakePort(id, info));
      return this.#ports.get(id);
    }

    unplug(id) {
      const port = this.#ports.get(id);
      this.#ports.delete(id);
      port.vanish();
      this.#tell("disconnect", port);
    }

    plugIn(given) { this.#tell("connect", this.port(given)); }

    #tell(type, port) {
      const event = new Event(type, { bubbles: true });
      Object.defineProperty(event, "target", { value: port });
      this.dispatchEvent(event);
    }
  }

  return new FakeSerial();
}
