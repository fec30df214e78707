// What each task adds to the page. The scripts of a task are in studies/tasks/<task>/report/.

/** The functions that fill the sections of the page, by the id of the section: (results, body, selection) => void. */
const BUILDERS = {};
const add_sections = (builders) => Object.assign(BUILDERS, builders);

const TASK_PAGES = [];

/**
 * @param page  `key` is the member of the results that the task adds. The rest replaces the same part of ANALYSIS_PAGE, and may be absent:
 *              headline(results, cases) -> text; verdict(results, parent); tiles(results, cases) -> elements; first(parent, results, selection) draws the panels
 *              of the first screen; design_table(body, results) follows the topographies
 */
const add_task_page = (page) => TASK_PAGES.push(page);

/** A part of the page of the task that these results are of. */
function task_part(results, part) {
  const has_any = (value) => list(value).length > 0 || Object.keys(record(value)).length > 0;
  return TASK_PAGES.find(({ key }) => has_any(results[key]))?.[part] ?? ANALYSIS_PAGE[part];
}
