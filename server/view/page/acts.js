/* acts.js: what may be asked for, why not, and what came of it. */

export class Acts {
  hello = null;
  over = false;

  /* `tell(words)` shows words of a refusal. */
  constructor(connection, token, tell) {
    this.connection = connection;
    this.token = token;
    this.tell = tell;
  }

  /* Whether a run of this kind has such an act at all. */
  has(act) {
    return this.hello?.acts.includes(act) ?? false;
  }

  /* Why it cannot be asked for now, in words; null: it can. */
  hindrance(act) {
    if (!this.has(act)) return 'no such act in this run';
    if (!this.token) return 'this address has no token, so it is for looking only';
    if (!this.connection.isOpen) return 'there is no connection';
    if (this.over) return 'the run is over';
    return null;
  }

  /* `what` says that it was not done, for when it was not. True when it was. */
  async ask(act, further, what) {
    const hindrance = this.hindrance(act);
    const refused = hindrance ?? await this.connection.ask(act, further);
    if (refused === null) return true;
    this.tell(`${what}: ${refused}`);
    return false;
  }
}

/* A button whose act may be hindered says why instead. */
export function markHindered(button, hindrance) {
  button.setAttribute('aria-disabled', String(hindrance !== null));
  if (button.dataset.title === undefined) button.dataset.title = button.title;
  const title = hindrance ?? button.dataset.title;
  if (button.title !== title) button.title = title;
}
