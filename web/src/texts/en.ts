// Every text of the page. What is said of a case comes from the engine; a translation of the page is another file
// like this one.
import type { Handle } from "../engine.js";

interface Length {
  metres: string;
  inches: string;
}

const vehicle = (number: number | null): string => (number ? `vehicle ${number}` : "the scene");

export const texts = {
  skip: "Skip to the answer",
  skipToViews: "Skip to the views",
  close: "Close",
  broken: "This page could not start its engine. It needs a browser of 2023 or later.",
  unitsLabel: "Units",
  units: [
    ["", "as in case"],
    ["si", "metric"],
    ["us", "US"],
    ["uk", "UK"],
  ],
  themeLabel: "Colours",
  themes: [
    ["auto", "auto"],
    ["light", "light"],
    ["dark", "dark"],
  ],

  pageTitle: (name: string, isSaved: boolean) => `${isSaved ? "" : "• "}${name} – deltav`,

  printHead: (name: string, version: string, date: string, since: string) =>
    [name, `deltav ${version}`, `printed ${date}`, since].filter((part) => part !== "").join(" · "),

  welcome: {
    label: "What this is",
    what: "The speeds of two vehicles before their collision, from damage, marks and recorders.",
    first: "This is an example. First choose “New case…” or “Open…”, then enter your numbers.",
    local: "Nothing that you enter leaves this page.",
    close: "Got it",
  },

  draft: {
    label: "Your draft",
    of: (time: string) => `This is your draft of ${time}, which this tab has kept.`,
    afresh: "Start afresh",
  },

  /** Labels that the keys themselves do not give. */
  labels: {
    avoid: "Avoidability",
    "avoid.limit": "Speed that is asked for (limit)",
    cg_to_front: "CG to front",
    cg_to_front_axle: "CG to front axle",
    pdof: "Principal direction of force (PDOF)",
    ees: "EES",
    delta_v_longitudinal: "ΔV along the vehicle",
    delta_v_lateral: "ΔV across the vehicle",
    delta_v_error: "Error of ΔV",
    delta_v_median: "Median ΔV",
    class: "Size class",
    category: "Stiffness category",
    A: "Stiffness A",
    B: "Stiffness B",
    G: "Stiffness G",
    d0: "d0 = A/√B",
    d1: "d1 = √B",
    "contact.x": "Forward of the CG (x)",
    "contact.y": "To the side of the CG (y)",
    tangential: "Along the crush plane (friction)",
    find: "Speed to find",
    from_force_balance: "From force balance",
    pre_crash: "Speed before the impact",
    pulse: "ΔV during the impact",
  } as Record<string, string>,

  /** What the words mean that stand for a choice in the file, by the last part of its key. */
  choices: {
    axes: { "z-up": "y to the left, angles counter-clockwise (z-up)", "z-down": "y to the right, angles clockwise (z-down, SAE J670)" },
    kind: { car: "car, van or pickup", "heavy-truck": "lorry, bus or tractor with semitrailer", trailer: "trailer", motorcycle: "motorcycle" },
    crush: { none: "none: its damage took no energy that counts" },
    stiffness: { fleet: "fleet: that of cars of 1991 to 2018" },
    fit: { exact: "exact: gives the energy of the test", mean: "mean: from the mean crush, a few per cent too high" },
    oblique: {
      capped: "capped: 1 + tan²α, α at most 45° (CRASH3)",
      uncapped: "uncapped: 1 + tan²α",
      secant: "secant: 1/cos α (Fonda)",
      none: "none: no correction",
    },
    when: { before: "before this impact", after: "after this impact" },
    law: { brach: "Brach", woolley: "Woolley", ishikawa: "Ishikawa", "kudlich-slibar": "Kudlich and Slibar" },
    tangential: { critical: "critical: sliding ends by separation" },
    find: { "vehicle1.speed": "speed of vehicle 1", "vehicle2.speed": "speed of vehicle 2" },
    energy_basis: { dissipated: "dissipated: what stays in the structure after rebound", absorbed: "absorbed: what it took at maximum engagement" },
    prior: { field: "field: as when a vehicle is towed", "serious-injury": "serious injury: as when someone is seriously hurt", flat: "flat: all speeds equally likely" },
    vehicle: { vehicle1: "vehicle 1", vehicle2: "vehicle 2" },
    swell_form: { linear: "linear: grows evenly", half: "half: half of it throughout", "full speed": "full speed: no deceleration before it is full" },
  } as Record<string, Record<string, string>>,

  station: (number: string) => `Depth C${number}`,

  file: {
    name: "Name of the case file",
    unsaved: "The case has changes that are not saved",
    new: "New case…",
    open: "Open…",
    save: "Save",
    undo: "Undo (Ctrl+Z)",
    redo: "Redo (Ctrl+Y)",
    discard: "The case has changes that are not saved. Discard them?",
    unreadable: (name: string) => `${name} is not a case file: it is not UTF-8 text.`,
  },

  templates: {
    title: "Start from",
    explain: "Each of these is a complete case that has an answer. Replace its numbers with yours.",
    printed: "in lb and ft, as it was printed",
    unitsLabel: "Units of the file",
    units: [
      ["si", "metric"],
      ["us", "US"],
    ],
  },

  save: {
    label: "Report",
    report: "Save the report (HTML)",
    live: "Save an interactive report",
    print: "Print the report",
    printView: "Print what is on the screen",
    json: "Save the results as JSON",
    csv: "Save the results as CSV",
    text: "Save the results as text",
    of: (title: string) => `Saves what is shown: ${title}`,
    answer: "the answer",
    whenWeighed: "All evidence is being weighed; then the file is saved.",
    completing: "The report is being made: its intervals contain the errors of the method.",
    ended: "Nothing is saved: the run was ended.",
    notRun: (title: string) => `There is nothing to save from ${title} yet: run it to its end for the case as it is now.`,
    nothing: "The case has no answer yet, so there is nothing to save.",
    noCsv: "This answer has no table as CSV.",
    noAnalyst: "The report is saved, but does not say at its top who hands it over: write your name in “Analyst” under “Report” in the form, and save it again.",
    noPlan: (name: string) => `The report draws the motion without ${name}: a page may not open files by itself. Lay that picture beneath the scene, and the report will include it.`,
  },

  about: {
    open: "About",
    paragraphs: [
      "deltav reconstructs the speeds of a two-vehicle collision from crush damage and planar impact mechanics.",
      "Everything is computed in this page. It needs no network, and its security policy forbids every connection: nothing that you enter leaves this computer.",
      "Until you close it, the tab keeps your case as a draft, so that a reload does not lose it. The next case that you open takes its place, and “Start afresh” removes it. A draft is no file: save the case to keep it.",
      "The engine is that of the program of the same name, and gives the same numbers to the last bit.",
      "The program can do some things that this page cannot: tables of many cases, the validation with its plots, several files at once, drawings as PDF, other steps of the force direction in the sensitivity, and results other than speeds and ΔV in the probability of an estimate.",
    ],
    engine: "SHA-256 of the engine:",
    licences: "Licences of what this page contains",
  },

  /** Links into the book, where the page lies beside it. */
  book: {
    more: "More in the book",
    method: "Book",
    start: "Open the book",
    choose: "Which method for what you have",
    of: (words: string, of: string) => `${words}: ${of}`,
  },

  questions: {
    reconstruct: "How fast were they?",
    impact: "What follows from these speeds?",
    motion: "Where do the vehicles come to rest?",
    crush: "What does the damage alone show?",
    estimate: "Which speeds agree with all evidence?",
    avoid: "Was it avoidable?",
    recorder: "What do the recorders show alone?",
  } as Record<string, string>,

  answer: {
    label: "Answer",
    question: "Question",
    noWarnings: "No warnings",
    warnings: (own: number, aside: number) => {
      const warnings = (count: number) => (count === 1 ? "1 warning" : `${count} warnings`);
      if (aside === 0) return warnings(own);
      return own === 0 ? `${warnings(aside)} on the exact solution` : `${warnings(own)}, and ${aside} on the exact solution`;
    },
    against: "Objections to the exact solution",
    byRangesAlone: {
      roomy: "These intervals do not contain the errors of the method. Those of the report do.",
      brief: "Without the errors of the method.",
    },
    takenAsExact: {
      roomy: "The inputs and the method are taken as exact, so these figures have no interval. The view Estimate gives intervals that include the errors of both.",
      brief: "Taken as exact, these figures have no interval.",
    },
    exact: (by: string) => `Exact solution by ${by}, not the answer:`,
    speed: (vehicle: number, figure: string) => `speed of vehicle ${vehicle} ${figure}`,
    deltaV: (vehicle: number, figure: string) => `ΔV of vehicle ${vehicle} ${figure}`,
    inResults: "This question is answered by tables.",
    inAvoid: "The speed at the impact is found first.",
    none: "No answer yet.",
    byEstimate: "An estimate answers this case: it finds the speeds from all its evidence together.",
    startEstimate: "Start the estimate",
    estimating: "All evidence is being weighed: the answer follows.",
    weighing: "More is known than one exact solution uses. All of it is being weighed: the answer follows.",
    notWeighed: "More is known than one exact solution uses, and it could not be weighed:",
    toField: "Go to the field",
    toLine: (line: number) => `Go to line ${line}`,
    andMore: (count: number) => (count === 1 ? "And 1 more problem." : `And ${count} more problems.`),
  },

  /** Words of the page for commands and options of the program, of which the engine speaks. */
  said: {
    commands: {
      reconstruct: "the reconstruction",
      impact: "the impact from given speeds",
      motion: "the motion to rest",
      crush: "the answer from the damage alone",
      uncertainty: "the view Uncertainty",
      sensitivity: "the view Sensitivity",
      compare: "the view Compare",
      estimate: "the view Estimate",
      recorder: "the view Recorder",
      avoid: "the view Avoidability",
      draw: "the view Drawings",
      check: "the view Inputs",
      new: "“New case…”",
      table: "the program's table of many cases",
      validate: "the program's validation",
    } as Record<string, string>,
    drawn: { scene: "the view Scene", motion: "the view Drawings" } as Record<string, string>,
    options: {
      units: "“Units” at the top",
      format: "“Report” at the top",
      "site-plan": "“Lay a plan or photo beneath…” in the view Scene",
      method: "“Method” in the view Uncertainty",
      sobol: "“Sobol' indices” in the view Uncertainty",
      above: "“Probability that” in the view Estimate",
      prior: "“Before the evidence” in the view Estimate",
      particles: "“Particles” in the view Estimate",
      plain: "“For readers who are not engineers” in the view Drawings",
    } as Record<string, string>,
    whatItMeans: "“What it means”, in the list of warnings at the top,",
    explanation: (topic: string) => `the explanation of “${topic}”`,
  },

  warnings: {
    explain: "What it means",
    lead: (name: string) => `Go to ${name}`,
  },

  sides: { label: "What is shown", view: "Answer", case: "Case" },
  caseTabs: { label: "Case", form: "Form", text: "Text" },
  viewTabs: {
    label: "Views",
    scene: "Scene",
    results: "Results",
    drawings: "Drawings",
    motion: "Motion",
    uncertainty: "Uncertainty",
    sensitivity: "Sensitivity",
    compare: "Compare",
    estimate: "Estimate",
    recorder: "Recorder",
    avoid: "Avoidability",
    inputs: "Inputs",
  } as Record<string, string>,

  editor: { label: "Text of the case file" },

  form: {
    label: "Case as a form",
    broken: "The file cannot be shown as a form until its error is corrected. “New case…” gives a form to fill in.",
    notPlain: (typed: string, plain: string) => [`“${typed}” is not a plain number.`, `Write ${plain}, with a decimal point and without a unit.`],
    sizeClass: (number: string, least: Length | undefined, most: Length | undefined) => {
      if (!least) return `${number}: to ${most?.metres} m (${most?.inches} in) wheelbase`;
      if (!most) return `${number}: from ${least.metres} m (${least.inches} in) wheelbase`;
      return `${number}: ${least.metres}–${most.metres} m (${least.inches}–${most.inches} in) wheelbase`;
    },
    categories: [
      ["1", "1: minicar"],
      ["2", "2: subcompact"],
      ["3", "3: compact"],
      ["4", "4: intermediate"],
      ["5", "5: full-size or large"],
    ] as [string, string][],
    notGiven: "not given",
    notGivenOption: "not given",
    byFields: "by its own fields",
    required: "(needed)",
    yes: "yes",
    no: "no",
    more: (count: number) => (count === 1 ? "1 more field" : `${count} more fields`),
    help: (title: string) => `Help: ${title}`,
    add: "Add",
    addTo: (title: string) => `Add: ${title}`,
    removeItem: "Remove",
    remove: (title: string) => `Remove: ${title}`,
    item: {
      points: "Point",
      path: "Point",
      other_path: "Point",
      edge: "Place",
      polygon: "Corner",
      zones: "Zone",
      records: "Record",
      other_impacts: "Impact",
      shared: "Error",
    } as Record<string, string>,
    inText: "in the text",
    inTextOf: (title: string) => `Edit in the text: ${title}`,
    unitOf: (title: string) => `Unit: ${title}`,
    knownOf: (title: string) => `How well it is known: ${title}`,
    known: "How well the number is known",
    modes: {
      exact: "exact",
      sd: "± std. dev.",
      uniform: "low to high",
      triangular: "low, likely, high",
      within: "± per cent",
      other: "other range",
    } as Record<string, string>,
    rangeKey: {
      value: "central value",
      values: "central values",
      sd: "standard deviation",
      low: "lowest value",
      mode: "most likely value",
      high: "highest value",
      within: "greatest deviation in per cent",
      confidence: "probability that it lies within",
    } as Record<string, string>,
    source: "source",
    fillIn: "fill in",
    forExample: (field: string, value: string) => `${field}, for example ${value}`,
    incomplete: "This range is not in the case yet: fill in all of its numbers.",
    rangeSign: { sd: "±", low: "from", mode: "likely", high: "to", within: "±", confidence: "probability" } as Record<string, string>,
  },

  scene: {
    title: "scene",
    which: "What is drawn",
    none: "There is no plan view of this case. What can be drawn of it is under Drawings.",
    error: "The case file has an error. Correct it, and the scene appears.",
    moved: (handle: Handle, values: string[]): string => `${texts.scene.handle(handle)}: ${values.join("; ")}`,
    impact: "At the impact",
    rest: "To rest",
    handles: "Handles of the scene",
    stage: "Scene: plus and minus zoom, 0 shows all of it, and the arrow keys move the view",
    hint: "Drag a vehicle or a handle, or focus a handle and press the arrow keys (Shift for larger steps, Alt for smaller). Escape undoes a drag. The wheel, or + and −, zooms; drag the empty ground, or use the middle button, to move the view.",
    body: (number: number) => `Vehicle ${number}: drag to move`,
    handle: (handle: Handle): string => {
      const of = vehicle(handle.vehicle);
      const names: Record<Handle["kind"], string> = {
        body: `Place of ${of}`,
        heading: `Heading of ${of}`,
        contact: `Contact point of ${of}`,
        plane: "Crush plane",
        rest: `Rest position of ${of}`,
        rest_heading: `Heading of ${of} at rest`,
        point: `Point ${(handle.index ?? 0) + 1} of the path of ${of}`,
        station: `Crush depth C${(handle.index ?? 0) + 1} of ${of}`,
      };
      return names[handle.kind];
    },
  },

  lens: {
    label: "Zoom and tape",
    larger: "Zoom in (+)",
    smaller: "Zoom out (−)",
    fit: "Fit",
    fitTitle: "Fit: show all of the scene (0)",
    factor: (factor: number) => `${factor.toFixed(1)}×`,
  },

  tape: {
    label: "Measuring tape",
    button: "Tape",
    title: "Tape: measure a length and a direction in the scene",
    hint: "Drag from point to point: near a marked point, the tape snaps to it. Arrow keys move an end (Shift for larger steps, Alt for smaller), and Enter takes it to the next marked point. Escape removes the tape. It is not part of the case.",
    cg: (number: number) => `CG of vehicle ${number}`,
    contact: "Contact point",
    end: (which: number, mark: string | null) => `${which === 0 ? "Start" : "End"} of the tape${mark === null ? "" : `: ${mark}`}`,
    reading: (length: string, degrees: string) => `${length} at ${degrees}°`,
  },

  backdrop: {
    add: "Lay a plan or photo beneath…",
    change: "Another picture…",
    remove: "Remove",
    scale: "Set scale",
    move: "Move",
    turn: "Angle of the picture in degrees",
    turnShort: "Turn",
    strength: "Strength of the picture",
    strengthShort: "Strength",
    distance: "Distance between the two points",
    set: "Set",
    scaleHint: "Click two points of the picture whose distance you know.",
    moveHint: "Drag the picture to its place.",
    noDistance: "Write the distance with its unit, for example 10 m or 32 ft.",
    scaled: "The scale is set.",
    keep: "Keep in the case",
    kept: "The case names this picture now. Save it in the folder of the case file, and the program draws the motion on it, too.",
    unreadable: "This file is not a picture that the browser can show.",
  },

  panels: {
    problems: "The case file has an error. Correct it, and this appears again.",
    cannot: "The case does not have what this needs.",
    plain: "For readers who are not engineers",
    plainLater: "All evidence is being weighed: these drawings follow, with its speeds.",
    plainOld: "The title or the source of the case has changed: these drawings, which show it, are made again with the next report.",
    noDrawings: "There is nothing to draw for this case.",
    table: "Table",
  },

  savers: {
    label: "Save:",
    kinds: { html: "HTML", json: "JSON", csv: "CSV", txt: "Text" } as Record<string, string>,
    of: (title: string, kind: string) => `Save ${title} as ${kind}`,
  },

  pictures: { svg: "Save SVG", png: "Save PNG" },

  sensitivity: {
    caption: (output: string) => `${output}: change in per cent, for 1 % more of the input, or for 1° more of an angle`,
    input: "input",
    influence: "influence",
    tables: "All derivatives",
  },

  run: {
    uncertainty: {
      what: "Numbers of the case that are ranges are drawn at random, and each sample is solved. Give a range in the form with the last list of a field.",
      start: "Run",
    },
    estimate: {
      what: "All evidence of the case is weighed together, including what is only known roughly. It takes seconds to minutes.",
      start: "Estimate",
    },
    samples: "Samples",
    method: "Method",
    indices: "Sobol' indices",
    indicesHelp: "Also computes which share of the variance each input causes, alone and with others. It takes 4,096 solutions for each input and two more.",
    methods: [
      ["monte-carlo", "Monte Carlo"],
      ["latin-hypercube", "Latin hypercube"],
      ["sobol", "Sobol sequence"],
    ],
    prior: "Before the evidence",
    priors: [
      ["", "as in case"],
      ["field", "as severe as field collisions"],
      ["serious-injury", "as severe as those with a serious injury"],
      ["flat", "all severities equally likely"],
    ],
    particles: "Particles, 16 times",
    above: "Probability that",
    quantities: [
      ["vehicle1.speed", "speed of vehicle 1"],
      ["vehicle2.speed", "speed of vehicle 2"],
      ["vehicle1.delta_v", "ΔV of vehicle 1"],
      ["vehicle2.delta_v", "ΔV of vehicle 2"],
    ],
    isAbove: "is above",
    limit: "The speed or ΔV, with its unit",
    limitExample: "50 km/h",
    seed: "Seed",
    end: "End",
    progress: "Progress",
    running: "Running…",
    ended: "Ended before it was done.",
    endedWithSome: "Ended before it was done. Below are the results of the first 100,000 samples.",
    old: "This is for the case before the last change.",
    done: (counted: string, done: number, total: number) => `${done.toLocaleString("en")} of ${total.toLocaleString("en")} ${counted}`,
    took: (milliseconds: number) => (milliseconds < 1000 ? `Took ${Math.round(milliseconds)} ms.` : `Took ${(milliseconds / 1000).toFixed(1)} s.`),
  },

  avoid: {
    finding: (done: string) => `The speed at the impact is being found: ${done}`,
    elsewhere: "The view Avoidability shows whether the collision was avoidable.",
    what: "Try other numbers",
    sliders: { "avoid.limit": "At a speed of", "avoid.reaction_time": "With a reaction time of" },
    use: "Use in the case",
    back: "Back to the case",
    moved: "These numbers are only tried out. The case, and what is saved, keep their own.",
  },

  recorder: {
    paste: "Paste a table from a report",
    how: "Select the table in the printed report with its heading, copy it, and paste it here. It does not matter how its columns are broken up.",
    example: "Times (sec)  Speed MPH [km/h]  Service Brake\n-1.0  36 [58]  Off\n-0.5  34 [55]  On\n0.0  30 [48]  On",
    of: "Recorder of",
    vehicles: [
      ["1", "vehicle 1"],
      ["2", "vehicle 2"],
    ],
    what: "Table",
    put: "Put into the case",
  },

  motion: {
    time: "Time",
    pace: "Pace",
    play: "Play",
    pause: "Pause",
    label: "Both vehicles from above, before and after the impact",
    paces: [
      ["0.1", "10 times slower"],
      ["0.25", "4 times slower"],
      ["1", "real time"],
    ],
    at: (seconds: number) => `${seconds < 0 ? "−" : "+"}${Math.abs(seconds).toFixed(2)} s`,
  },

  live: {
    banner: (name: string, version: string, { analyst, date }: { analyst: string; date: string }) =>
      `This is an interactive report: ${name}, with deltav ${version}. ${analyst === "" ? "It does not say who handed it over." : `Handed over by ${analyst}${date === "" ? "" : `, ${date}`}.`}`,
    unchanged: "No number has been changed.",
    changed: "The case has been changed since it was handed over: the answer below is not that of the report.",
    changedPrinted: "The case has been changed since the report was handed over",
    toPrinted: "Go to the report as it was printed",
    printed: "The report as it was printed",
    explain: "Below is the report as it was handed over, unchanged. Above it, change any number and see what follows.",
    report: "SHA-256 of the report",
    engine: "SHA-256 of the engine",
    case: "SHA-256 of the case, as the report prints it",
    foreign: "The case in this page is not the one of its report: somebody has changed one of them.",
    checking: "checking…",
    holds: "holds",
    fails: "does not hold: this is not what was handed over",
  },
};
