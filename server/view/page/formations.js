/* formations.js: the formations there are, one button each. */

import { markHindered } from './acts.js';

export class Formations {
  #names = [];

  /* `draw()` is called when somebody wants a new one. */
  constructor(card, acts, draw) {
    this.card = card;
    this.acts = acts;
    this.choices = card.querySelector('.choices');
    this.new = document.createElement('button');
    this.new.type = 'button';
    this.new.className = 'new';
    this.new.textContent = 'Draw a new one …';
    this.new.title = 'Place vertices about the leader (D)';
    this.new.addEventListener('click', draw);
    this.choices.append(this.new);
  }

  /* `now`: the one in force. */
  show(names, now) {
    const { acts, card } = this;
    card.hidden = !acts.has('formation') && !acts.has('draw');
    if (card.hidden) return;
    if (names.join('\n') !== this.#names.join('\n')) this.#make(names);
    for (const button of this.choices.children) {
      if (button === this.new) continue;
      button.ariaPressed = String(button.textContent === now);
      markHindered(button, acts.hindrance('formation'));
    }
    this.new.hidden = !acts.has('draw');
    markHindered(this.new, acts.hindrance('draw'));
  }

  #make(names) {
    this.#names = [...names];
    const buttons = names.map((name) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = name;
      button.addEventListener('click', () => {
        this.acts.ask('formation', { name }, `The formation was not changed to ${name}`);
      });
      return button;
    });
    this.choices.replaceChildren(...buttons, this.new);
  }
}
