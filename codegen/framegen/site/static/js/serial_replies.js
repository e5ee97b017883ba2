// Which message answers which question. Times are in milliseconds.
"use strict";

// How long the other end may take for a reply, beyond the time on the wire, if the user does not say;
// the Python client waits as long.
const REPLY_TIMEOUT_MS = 250;
// So long after a question was given up, a reply to it is still known as its own.
const LATE_MS = 10_000;

// The values of a field by path, `ids` or `items.id`: one for each element of a list.
function valuesAt(fields, path) {
  const [name, inner] = path.split(".");
  const value = fields[name];
  if (value === null || value === undefined) return [];
  if (!Array.isArray(value)) return [value];
  return inner ? value.map((item) => item[inner]) : value;
}

// Whether a reply holds as many items as were asked for, or says why it does not.
function countFits({ asked, held, failure, good }, question, event) {
  if (failure && Number(event.fields[failure]) !== good) return true;
  const value = question.fields[asked];
  return event.fields[held].length === (Array.isArray(value) ? value.length : Number(value));
}

// `data` is what line_data.py says: the exchanges and the link. `baud` is the rate of the line.
function makeReplies(data, baud, timeout = REPLY_TIMEOUT_MS) {
  let pending = [], lost = [];
  const onWire = (bytes) => (1000 * bytes * data.bitsPerByte) / baud;
  const addressOf = (event, path) => event.rows.find((row) => row.path === path)?.value;

  function answers({ event: question, exchange }, event) {
    if (event.message !== exchange.reply && event.message !== exchange.refusal) return false;
    const { address, silent } = exchange;
    if (address && addressOf(event, address) !== addressOf(question, address)
      && !silent.includes(Number(addressOf(question, address)))) return false;
    if (event.message !== exchange.reply) return true;
    if (exchange.counted && !countFits(exchange.counted, question, event)) return false;
    // A reply holds nothing that was not asked for.
    return exchange.echoed.every(([asked, said]) => {
      const left = valuesAt(question.fields, asked);
      return valuesAt(event.fields, said).every((value) => {
        const at = left.indexOf(value);
        if (at >= 0) left.splice(at, 1);
        return at >= 0;
      });
    });
  }

  // What was asked for and is not in the reply, in words.
  function missing({ event: question, exchange }, event) {
    if (event.message !== exchange.reply) return [];
    return exchange.echoed.flatMap(([asked, said]) => {
      const there = valuesAt(event.fields, said);
      const left = [...new Set(valuesAt(question.fields, asked))].filter((value) => !there.includes(value));
      return left.length ? [`${asked} ${left.join(", ")}`] : [];
    });
  }

  return {
    // A message was handed to the line: a question that is waited for, or null where nothing answers it.
    sent(event, now) {
      const exchange = data.exchanges[event.message];
      if (!exchange?.reply) return null;
      const size = event.bytes.length, within = onWire(size + exchange.largest) + timeout;
      const question = { event, exchange, sentAt: now, within, until: now + within };
      pending.push(question);
      return question;
    },

    // A message has come: the question that it answers, how long that took, and whether it came too
    // late; null where nobody has asked for it.
    received(event, now) {
      lost = lost.filter(({ until }) => now < until + LATE_MS);
      const asked = pending.find((question) => answers(question, event));
      const given = lost.find((question) => answers(question, event));
      // A reply that is here before both frames have had their time on the wire answers something earlier.
      const soonest = asked && onWire(asked.event.bytes.length + event.bytes.length);
      const question = asked && given && now - asked.sentAt < soonest ? given : asked ?? given;
      if (!question) return null;
      const late = question === given;
      if (late) lost = lost.filter((each) => each !== question);
      else pending = pending.filter((each) => each !== question);
      return { question, event, took: now - question.sentAt, late, missing: missing(question, event) };
    },

    forget(question) { pending = pending.filter((each) => each !== question); },

    // The questions whose time is over.
    expire(now) {
      const over = pending.filter(({ until }) => until <= now);
      pending = pending.filter(({ until }) => until > now);
      lost.push(...over);
      return over;
    },

    // The line is gone: the questions that nobody answers any more.
    clear() {
      const gone = pending;
      [pending, lost] = [[], []];
      return gone;
    },

    get due() { return pending.length ? Math.min(...pending.map(({ until }) => until)) : null; },
    get waiting() { return pending.length > 0; },
  };
}
