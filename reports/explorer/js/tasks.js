// The user's tasks among kinds of jobs and labels of work: "task:NAME".

const TASK = "task:";

export function isTask(label) {
  return label.startsWith(TASK);
}

export function taskName(label) {
  return label.slice(TASK.length);
}
