/* token.js: what lets somebody act comes behind the # of the address. It is taken from there, lest it be
 * copied or bookmarked with the address, and kept for as long as the tab is open. */

const KEY = 'muster-token';

export function takeToken() {
  const token = location.hash.slice(1);
  if (token) history.replaceState(null, '', location.pathname + location.search);
  window.addEventListener('hashchange', () => location.reload());
  return kept(token);
}

/* A browser that keeps nothing forgets it when the page is loaded again. */
function kept(token) {
  try {
    if (token) sessionStorage.setItem(KEY, token);
    return token || (sessionStorage.getItem(KEY) ?? '');
  } catch {
    return token;
  }
}
