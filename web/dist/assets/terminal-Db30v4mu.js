import{S as e,h as t,p as n,w as r,x as i}from"./index-Qc_W3yad.js";import{n as a}from"./files-DqKkerva.js";import{t as o}from"./tab-lKZc--Iv.js";function s(e){return/^\s*([A-Za-z]*)/.exec(e)?.[1]??``}function c(e,t){let n=s(t).toUpperCase();if(n===``||t.trim()!==s(t))return[];let r=new Set,i=e.filter(({name:e,syntax:t})=>{let i=e.toUpperCase().startsWith(n)&&!r.has(t);return i&&r.add(t),i});return i.sort((e,t)=>e.name.length-t.name.length||e.name.localeCompare(t.name)),i.slice(0,12)}function l(e,t){let n=s(t).toUpperCase();if(n===``)return[];let r=e.filter(({name:e})=>e!==``&&n.startsWith(e.toUpperCase())),i=Math.max(0,...r.map(({name:e})=>e.length));return r.filter(({name:e})=>e.length===i)}var u=class{#e;#t;#n=``;constructor(e=[]){this.#e=e.slice(-200),this.#t=this.#e.length}get lines(){return this.#e}add(e){e!==``&&e!==this.#e.at(-1)&&(this.#e=[...this.#e,e].slice(-200)),this.#t=this.#e.length,this.#n=``}older(e){return this.#t===0?null:(this.#t===this.#e.length&&(this.#n=e),--this.#t,this.#e[this.#t]??null)}newer(){return this.#t===this.#e.length?null:(this.#t+=1,this.#e[this.#t]??this.#n)}};function d(e,{words:t,direction:n,polled:r}){let i=t.toLowerCase().split(/\s+/).filter(e=>e!==``&&e!==`-`);return e.filter(e=>e.polled&&!r||n!==`both`&&e.out!==(n===`out`)?!1:i.every(t=>t.startsWith(`-`)?!f(e,t.slice(1)):f(e,t)))}function f(e,t){return e.text.toLowerCase().includes(t)?!0:/^([0-9a-f]{2})+$/.test(t)&&p(e.hex,t)}function p(e,t){let n=e.replace(/\s/g,``).toLowerCase();for(let e=n.indexOf(t);e>=0;e=n.indexOf(t,e+1))if(e%2==0)return!0;return!1}function m(e){let t=e=>`"${e.replaceAll(`"`,`""`)}"`;return[`seconds,direction,hex,text`,...e.map(({at:e,out:n,hex:r,text:i})=>[e.toFixed(6),n?`out`:`in`,r,t(i)].join(`,`)),``].join(`\r
`)}var h=class extends o{static properties={...o.properties,typed:{state:!0},exchanges:{state:!0},hex:{state:!0},filter:{state:!0},paused:{state:!0}};watches=[`traffic`];#e=null;#t=null;static styles=[n,r`
      .row > select {
        width: auto;
        max-width: 100%;
      }
      .columns {
        display: grid;
        grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
        gap: var(--gap);
      }
      .panel {
        display: flex;
        flex-direction: column;
        gap: 8px;
        height: calc(100dvh - 150px);
        min-height: 420px;
      }
      .log,
      .table {
        flex: 1 1 0;
        min-height: 0;
        overflow: auto;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--bg);
      }
      .log {
        padding: 8px 10px;
        font-family: var(--mono);
        font-size: 13px;
        overflow-wrap: anywhere;
      }
      .log .sent {
        color: var(--accent);
        margin-top: 4px;
      }
      .log .more {
        color: var(--muted);
        padding-left: 2ch;
      }
      .log .reply {
        padding-left: 2ch;
        white-space: pre-wrap;
      }
      .help {
        max-height: 220px;
        overflow: auto;
        border: 1px solid var(--line);
        border-radius: var(--radius);
      }
      .help button {
        display: grid;
        grid-template-columns: minmax(0, 3fr) minmax(0, 5fr) minmax(0, 2fr) 4em;
        gap: 10px;
        width: 100%;
        min-height: 26px;
        font-size: 13px;
        font-weight: 400;
        text-align: left;
        white-space: normal;
      }
      .line input {
        flex: 1 1 12em;
        font-family: var(--mono);
      }
      .table table {
        table-layout: fixed;
        font-family: var(--mono);
        font-size: 12px;
      }
      .table th {
        position: sticky;
        top: 0;
        background: var(--panel);
      }
      .table td {
        padding: 1px 8px;
        overflow-wrap: anywhere;
      }
      .table .out {
        color: var(--accent);
      }
      .at {
        width: 84px;
      }
      .way {
        width: 42px;
      }
      input.filter {
        width: auto;
        flex: 1 1 10em;
      }
      @media (max-width: 900px) {
        .columns {
          grid-template-columns: minmax(0, 1fr);
        }
        .panel {
          height: 70dvh;
        }
      }
    `];constructor(){super(),this.typed=``,this.exchanges=[],this.hex=!1,this.filter={words:``,direction:`both`,polled:!1},this.paused=null}get#n(){return`terminal ${this.device.name}`}get#r(){return this.#e??=new u(JSON.parse(sessionStorage.getItem(this.#n)??`[]`)),this.#e}async#i(e){e.preventDefault();let n=this.typed.trim();if(n===``)return;this.#r.add(n),sessionStorage.setItem(this.#n,JSON.stringify(this.#r.lines)),this.#a(``);let r={line:n,answer:null,problem:null};this.exchanges=[...this.exchanges,r].slice(-500);try{r.answer=await this.api.terminal(this.device.name,n)}catch(e){r.problem=t(e)}this.requestUpdate()}#a(e){this.typed=e,this.#t=null}#o(e){if(e.key===`ArrowUp`||e.key===`ArrowDown`){let t=e.key===`ArrowUp`?this.#r.older(this.typed):this.#r.newer();t!==null&&this.#a(t),e.preventDefault()}else e.key===`Tab`&&this.#s(e.shiftKey?-1:1)&&e.preventDefault()}#s(e){let t=this.#t??{names:this.#c(),at:e>0?-1:0};return t.names.length===0||t.names.length===1&&t.names[0]===this.typed?!1:(t.at=(t.at+e+t.names.length)%t.names.length,this.typed=t.names[t.at]??``,this.#t=t,!0)}#c(){return[...new Set(c(this.catalog.commands,this.typed).map(({name:e})=>e))]}#l(e){this.#a(e.name),this.renderRoot.querySelector(`#line`)?.focus()}updated(){this.#u(`.log`),this.paused===null&&this.#u(`.table`)}#u(e){let t=this.renderRoot.querySelector(e);t&&t.dataset.away!==`true`&&(t.scrollTop=t.scrollHeight)}#d(e){let t=e.currentTarget;t.dataset.away=String(t.scrollHeight-t.scrollTop-t.clientHeight>24)}render(){return e`<div class="columns">${this.#f()} ${this.#g()}</div>`}#f(){let t=this.catalog.language===`tmcl`;return e`
      <section class="panel" aria-label="Command line">
        <div class="row">
          <h2 class="grow">Command line</h2>
          <label class="line"><input type="checkbox" .checked=${this.hex} @change=${this.#p} />bytes</label>
          <button class="small" @click=${()=>this.exchanges=[]}>Clear</button>
        </div>
        <div class="log" role="log" aria-label="Answers" tabindex="0" @scroll=${this.#d}>
          ${this.exchanges.length===0?e`<p class="muted">
                ${t?`Commands as in direct mode: GAP 1, 0. Or nine bytes in hex.`:`Commands as on the wire: PX.`}
                Arrow keys bring back earlier lines, Tab completes.
              </p>`:this.exchanges.map(e=>this.#m(e))}
        </div>
        <div id="help" class="help" role="group" aria-label="Help" ?hidden=${this.typed===``}>${this.#h()}</div>
        <form class="row line" @submit=${this.#i}>
          <input
            id="line"
            aria-label="Command"
            aria-describedby="help"
            placeholder=${t?`GAP 1, 0`:`PX`}
            autocomplete="off"
            autocapitalize="characters"
            spellcheck="false"
            maxlength="256"
            .value=${this.typed}
            @input=${e=>this.#a(e.target.value)}
            @keydown=${this.#o}
          />
          <button class="primary" ?disabled=${!this.reachable}>Send</button>
        </form>
      </section>
    `}#p(e){this.hex=e.target.checked}#m({line:t,answer:n,problem:r}){return e`
      <div class="sent">&gt; ${t}</div>
      ${r===null?i:e`<div class="reply error-text">${r}</div>`}
      ${n===null?i:e`
            <div class="reply ${n.ok?``:`error-text`}">${n.reply}</div>
            ${n.text!==n.reply&&n.text!==``?e`<div class="more">${n.text}</div>`:i}
            ${this.hex?e`<div class="more">→ ${n.hex_request}</div>
                  <div class="more">← ${n.hex_reply}</div>`:i}
          `}
    `}#h(){let t=c(this.catalog.commands,this.typed),n=t.length>0?t:l(this.catalog.commands,this.typed);return n.length===0?i:n.map(t=>e`
        <button class="plain" @click=${()=>this.#l(t)}>
          <code>${t.syntax}</code>
          <span>${t.text}${t.unit?e` <span class="muted">[${t.unit}]</span>`:i}</span>
          <code class="muted">${t.example}</code>
          <span class="muted">${t.section}</span>
        </button>
      `)}#g(){let t=d(this.paused??this.live.traffic,this.filter),n=t.slice(-200);return e`
      <section class="panel" aria-label="Traffic">
        <div class="row">
          <h2 class="grow">Traffic</h2>
          <button class="small" aria-pressed=${this.paused!==null} @click=${this.#y}>Pause</button>
          <button class="small" @click=${this.#b}>Clear</button>
          <button class="small" ?disabled=${t.length===0} @click=${()=>this.#x(t)}>Export</button>
        </div>
        <div class="row">
          <input
            class="filter"
            type="search"
            aria-label="Filter"
            placeholder="Filter: words, hex, -without"
            spellcheck="false"
            .value=${this.filter.words}
            @input=${e=>this.#_({words:e.target.value})}
          />
          <select aria-label="Direction" @change=${this.#v}>
            <option value="both">both ways</option>
            <option value="out">requests</option>
            <option value="in">replies</option>
          </select>
          <label class="line" title="What the page asks to see what the controller is doing">
            <input type="checkbox" .checked=${this.filter.polled}
              @change=${e=>this.#_({polled:e.target.checked})} />polling</label>
          <span class="muted">${t.length} lines</span>
        </div>
        <div class="table" tabindex="0" role="region" aria-label="Lines of traffic" @scroll=${this.#d}>
          <table aria-label="Requests and replies">
            <thead>
              <tr>
                <th class="at number">s</th>
                <th class="way"></th>
                <th>Bytes</th>
                <th>Words</th>
              </tr>
            </thead>
            <tbody>
              ${n.map(({at:t,out:n,hex:r,text:i})=>e`
                  <tr class=${n?`out`:`in`}>
                    <td class="number">${t.toFixed(3)}</td>
                    <td><span aria-hidden="true">${n?`→`:`←`}</span
                      ><span class="visually-hidden">${n?`request`:`reply`}</span></td>
                    <td>${r}</td>
                    <td>${i}</td>
                  </tr>
                `)}
            </tbody>
          </table>
        </div>
      </section>
    `}#_(e){this.filter={...this.filter,...e}}#v(e){this.#_({direction:e.target.value})}#y(){this.paused=this.paused===null?this.live.traffic:null}#b(){this.paused!==null&&(this.paused=[]),this.live.clearTraffic()}#x(e){a(`${this.device.name}-traffic.csv`,m(e),`text/csv`)}};customElements.define(`pt-terminal`,h);