// Names and equations as one writes them on a board: rho_i -> ρ with a small i, div B -> ∇·B, sqrt -> √.
const LETTERS = {
  alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", eta: "η", theta: "θ", kappa: "κ", lambda: "λ", mu: "μ",
  nu: "ν", xi: "ξ", pi: "π", rho: "ρ", sigma: "σ", tau: "τ", phi: "φ", chi: "χ", psi: "ψ", omega: "ω",
  Gamma: "Γ", Delta: "Δ", Sigma: "Σ", Phi: "Φ", Psi: "Ψ", Omega: "Ω",
};
const WORD = new RegExp(`(?<![A-Za-z])(d?)(${Object.keys(LETTERS).join("|")})(?![A-Za-z])`, "g");
const SIGNS = [
  [/\bdiv_B\b/g, "h|∇·B|/|B|"],
  [/\bdiv (?=[A-Za-z(])/g, "∇·"],
  [/\bcurl (?=[A-Za-z(])/g, "∇×"],
  [/\bgrad (?=[A-Za-z(])/g, "∇"],
  [/\bsqrt(?=[ (])/g, "√"],
  [/(?<![A-Za-z])sum(?=_)/g, "Σ"],
  [/\^2/g, "²"],
  [/\^3/g, "³"],
  [/<=/g, "≤"],
  [/>=/g, "≥"],
  [/ - /g, " − "],
];

/** Prose or a name with Greek letters and signs. */
export function greek(text) {
  const letters = String(text).replace(WORD, (_, d, name) => d + LETTERS[name]);
  return SIGNS.reduce((line, [pattern, sign]) => line.replace(pattern, sign), letters);
}

/** An equation as nodes: Greek letters, dots of products, and what follows an underscore as a subscript. */
export function equation(text) {
  const line = greek(text.replace(/\bG([ij])\b/g, "G_$1")).replace(/(?<=[A-Za-zΑ-ω]\w*)\.(?=[A-Za-z])/g, "·");
  const nodes = document.createDocumentFragment();
  line.split(/_(\w+)/).forEach((piece, k) => {
    if (k % 2 === 0) return nodes.append(piece);
    const low = document.createElement("sub");
    low.textContent = piece;
    nodes.append(low);
  });
  return nodes;
}

/** A name as one line of text, where no subscript can stand (an option, a label read aloud): B_z, ρ, |v|. */
export function symbol(name, axis = null, components = 1) {
  if (components === 1) return greek(name);
  return axis === null ? `|${greek(name)}|` : `${greek(name)}_${"xyz"[axis]}`;
}
