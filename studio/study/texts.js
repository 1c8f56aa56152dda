// All texts of the participant's page, in English, but those of the study itself, which the server gives.

const times = (count) => ["", "once", "twice"][count] ?? `${count} times`;
const list = new Intl.ListFormat("en", { type: "conjunction" });

export const texts = {
  place: (index, of) => (index < of ? `Step ${index + 1} of ${of}` : "All steps are done"),
  titled: (heading, title) => `${heading} – ${title}`,
  next: "Next",
  begin: "Begin",
  go_on: "Continue",
  done: "Done",

  server: {
    silent: "The study’s server does not answer.",
    silent_help: "Please leave this page open: it tries again every three seconds, and nothing is lost.",
    retry: "Try now",
    unreadable: "The server’s answer could not be read.",
    unreadable_help: "Please tell the person who runs the study.",
    refused_again: "Try again",
    elsewhere: "That step was answered already, perhaps in another tab.",
    elsewhere_help: "Here is the step that is open. Please go on in one tab only.",
    broken: "Something in this page failed.",
    broken_help: "Please reload the page: it goes on where you are.",
  },

  join: {
    connecting: "One moment …",
    unknown: "Welcome",
    unknown_text: "Your earlier visit is not known here any more, so that the study would begin anew.",
    full: "This study is full",
    full_text: "All places are taken. Thank you for your interest!",
  },

  consent: {
    heading: "Welcome",
    sound: "You will hear the surfaces. Please put your headphones on, or switch your loudspeakers on, before you begin.",
    agree: "By pressing “Begin” you agree to take part.",
  },

  resume: {
    heading: "Welcome back",
    text: "The study goes on with the step that you were at.",
  },

  stage: {
    label: "Surface to stroke and tap",
    region: "The surface",
    hint: "Drag over it to stroke it, press it briefly to tap it. By keyboard: arrows stroke, Space taps, Shift presses harder.",
    device: (name) => `Stroke and tap the surface with the device (${name}).`,
    force: "How hard you press",
    force_text: (newtons) => `${newtons.toFixed(1)} N`,
  },

  rating: {
    loading: "The surface is being prepared …",
    heading: "How does this surface feel?",
    practice: "Practice: how does this surface feel?",
  },

  scale: {
    untouched: "not moved yet",
    value: (value) => `${value}`,
    spoken: (value, { low, high, most }) => `${value} of ${most}, from ${low} to ${high}`,
    point: (value, { low, high, least, most }) => [value, ...(value === least ? [low] : value === most ? [high] : [])].join(", "),
  },

  /** What has to be done before a step can be left. */
  missing: {
    all: (parts) => (parts.length ? `Before you go on, please ${list.format(parts)}.` : ""),
    strokes: (count, some) => `stroke the surface ${times(count)}${some ? " more" : ""}`,
    taps: (count, some) => `tap it ${times(count)}${some ? " more" : ""}`,
    seconds: "touch it a little longer",
    sliders: (count, of) => (count === of ? "move the slider of each question"
      : `move the other ${count === 1 ? "slider" : `${count} sliders`} of the questions`),
    answers: (count) => (count === 1 ? "answer the last question" : `answer ${count} questions`),
    prompt: "describe a surface and try it",
    wait: "rest until the break is over",
    sending: "Your answer is being saved …",
  },

  break: {
    heading: "A short break",
    text: (done, total) => `${done} of ${total} surfaces are done. Rest your hand and your ears for a while.`,
    left: (seconds) => `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`,
    timer: "Time until you can go on",
    over: "You can go on whenever you like.",
  },

  prompt: {
    heading: "Describe a surface",
    label: "The surface, in your own words",
    try: "Try",
    refine: (left) => (left === 1 ? "Refine once" : `Refine, ${left} times left`),
    making: "The surface is being made …",
    made: (prompt) => `This is “${prompt}”. Explore it.`,
    last: "It cannot be refined further.",
    empty: "Please describe a surface first, such as “wet ice”.",
  },

  end: {
    heading: "The end",
    other: "Another participant begins here",
  },

  withdraw: {
    open: "Stop and delete my answers",
    title: "Stop and delete your answers?",
    text: "All that was recorded of you is deleted for good, and the study ends here.",
    yes: "Delete my answers",
    no: "Go on with the study",
    done: "Your answers are deleted",
    done_text: "Nothing is kept of your visit. You may close this page.",
  },

  sound: {
    suspended: "Your browser holds the sound back.",
    suspended_help: "The surfaces are felt by ear.",
    start: "Switch the sound on",
    no_worklet: "This browser cannot play the surfaces.",
    no_worklet_help: "Please open this address in a current Chrome, Edge, Firefox or Safari.",
    failed: "The sound has failed.",
    failed_help: "Check that loudspeakers or headphones are connected, and try again.",
    refused: "This surface cannot be played.",
    refused_help: "Please tell the person who runs the study.",
  },
};
