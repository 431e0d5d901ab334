/* toast.js: words that come by themselves and go again. */

const STAYS = 9000; /* ms */

export function toast(words) {
  const box = document.createElement('div');
  const text = document.createElement('p');
  const close = document.createElement('button');
  box.className = 'toast';
  box.role = 'alert';
  text.textContent = words;
  close.type = 'button';
  close.textContent = '×';
  close.ariaLabel = 'Dismiss';
  close.addEventListener('click', () => box.remove());
  box.append(text, close);
  const all = document.getElementById('toasts');
  all.append(box);
  while (all.children.length > 3) all.firstChild.remove();
  setTimeout(() => box.remove(), STAYS);
}
