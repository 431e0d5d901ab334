/* words.js: what numbers of the protocol are called, and how values are written. */

const STATES = ['boot', 'idle', 'ready', 'run', 'hold', 'emergency stop', 'trial', 'spent'];
const FAULTS = ['no id', 'pose stale', 'link lost', 'stall', 'emergency stop', 'mission refused', 'battery critical',
                'battery low'];
const ROLES = ['electing', 'leader', 'follower'];
const STATE_RUN = 3;
const WARNINGS = 128; /* faults that are none */

export function roleWord(role) {
  return ROLES[role] ?? '?';
}

export function faultWords(faults) {
  return FAULTS.filter((_, bit) => faults & (1 << bit));
}

/* Whether a robot needs somebody's attention. */
export function troubled(scene, i) {
  return !scene.alive(i) || scene.stalled(i) || scene.muted(i) || !scene.linked(i) ||
    (scene.faults(i) & ~WARNINGS) !== 0;
}

/* What a robot does, or what is wrong with it. */
export function conditionWords(scene, i) {
  if (!scene.alive(i)) return 'dead';
  const words = faultWords(scene.faults(i));
  if (scene.stalled(i)) words.unshift('stalled');
  if (scene.muted(i)) words.unshift('muted');
  if (!scene.linked(i) && !words.includes('link lost')) words.push('not linked');
  const state = scene.state(i);
  const said = STATES[state] ?? '?';
  if (words.length === 0 || (state !== STATE_RUN && !words.includes(said))) words.unshift(said);
  return words.join(', ');
}

/* What an event says, as a sentence would. */
export function eventWords({ event, detail }) {
  switch (event) {
  case 'role': return `is ${{ L: 'leader', F: 'follower', C: 'electing' }[detail] ?? detail}`;
  case 'election': return `won the election, ${detail}`;
  case 'vertex_won': return `won vertex ${detail}`;
  case 'vertex_lost': return `lost vertex ${detail}`;
  case 'fault': return detail === 'none' ? 'has no fault any more' : detail;
  case 'kill': return 'was killed';
  case 'revive': return 'was revived';
  case 'stall': return 'was stalled';
  case 'mute': return 'was muted';
  case 'unmute': return 'is heard again';
  case 'drain': return 'was drained';
  case 'estop': return 'emergency stop';
  default: return [event.replaceAll('_', ' '), detail].filter(Boolean).join(': ');
  }
}

/* How grave: 2 something broke, 1 the fleet reacts, 0 the rest. */
export function eventWeight({ event, detail }) {
  if (event === 'kill' || event === 'estop' || event === 'stall') return 2;
  if (event === 'fault' || event === 'link_error') return detail === 'none' ? 0 : 2;
  if (event === 'role') return detail === 'L' ? 1 : 0;
  return event.startsWith('vertex') || event === 'election' ? 0 : 1;
}

/* With a true minus, and no minus before zero. */
export function fixed(value, digits) {
  const said = value.toFixed(digits);
  return Number(said) === 0 ? said.replace('-', '') : said.replace('-', '−');
}

export function metres(value) {
  if (!Number.isFinite(value)) return '–';
  return value < 10 ? value.toFixed(3) : value.toFixed(1);
}

export function clockTime(seconds, digits = 2) {
  const sign = seconds < 0 ? '−' : '';
  const whole = Number(Math.abs(seconds).toFixed(digits)); /* 59.98 is 1:00.0 */
  if (whole < 60) return `${sign}${whole.toFixed(digits)} s`;
  const minutes = Math.floor(whole / 60);
  const rest = (whole - 60 * minutes).toFixed(digits).padStart(digits ? digits + 3 : 2, '0');
  if (minutes < 60) return `${sign}${minutes}:${rest}`;
  return `${sign}${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, '0')}:${rest}`;
}
