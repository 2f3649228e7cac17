import { useEffect, useState } from "preact/hooks";

/** Where all panels are in one place, below the field. */
const kNarrow = "(max-width: 900px)";

export const isNarrowNow = (): boolean => matchMedia(kNarrow).matches;

export function useNarrow(): boolean {
  const [isNarrow, setNarrow] = useState(isNarrowNow);
  useEffect(() => {
    const query = matchMedia(kNarrow);
    const changed = () => setNarrow(query.matches);
    query.addEventListener("change", changed);
    return () => query.removeEventListener("change", changed);
  }, []);
  return isNarrow;
}
